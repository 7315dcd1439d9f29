#include "server/alarms/announcer.hpp"

#include <charconv>
#include <utility>

#include "engine/run/frame.hpp"

namespace vigil {
namespace {

std::string topic_of(RunId run, const char* what) { return "runs/" + std::to_string(run) + "/" + what; }

bool is_over(const std::string& state) {
  return state == "finished" || state == "stopped" || state == "failed" || state == "interrupted";
}

/// Of "runs/<id>/state".
std::optional<RunId> run_of(const std::string& topic) {
  if (!topic.starts_with("runs/") || !topic.ends_with("/state")) return std::nullopt;
  const char* const end = topic.data() + topic.size() - 6;
  RunId run = 0;
  const auto read = std::from_chars(topic.data() + 5, end, run);
  return read.ec == std::errc() && read.ptr == end ? std::optional(run) : std::nullopt;
}

std::string dumped(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

}  // namespace

Announcer::Announcer(std::vector<std::unique_ptr<AlarmSink>> sinks, AnnouncerOptions options)
    : options_(std::move(options)) {
  const auto asked = [this](const std::string& topic, const std::string& text) { return right(topic, text); };
  for (auto& sink : sinks) outboxes_.push_back(std::make_unique<Outbox>(std::move(sink), asked, options_.queue));
}

void Announcer::alarm(RunId run, const Mark& mark) {
  if (outboxes_.empty()) return;
  Json json = to_json(mark);
  json["run"] = std::to_string(run);
  const std::string text = dumped(json);
  for (const auto& outbox : outboxes_) outbox->put({topic_of(run, "alarms"), text, false});
  const std::lock_guard lock(mutex_);
  const auto place = live_.find(run);
  if (place == live_.end()) return;
  auto& nodes = place->second.alarms[mark.lane];
  if (mark.edge == MarkEdge::end)
    nodes.erase(mark.node);
  else
    nodes.emplace(mark.node, mark.k);
  place->second.note["k"] = mark.k;
  place->second.note.erase("t");  // it was of an earlier tick
  say_state(run, place->second, true);
}

void Announcer::state(RunId run, const Json& note, const std::vector<std::string>& lanes) {
  if (outboxes_.empty()) return;
  const bool over = is_over(note.at("state").get<std::string>());
  const std::lock_guard lock(mutex_);
  Live& live = live_[run];
  live.note = note;
  for (const std::string& lane : lanes) live.alarms[lane];
  say_state(run, live, !over);
  if (over) live_.erase(run);
}

/// mutex_ is held, so that states go out in the order in which they were.
void Announcer::say_state(RunId run, const Live& live, bool lasting) {
  Json json = live.note;
  json.erase("id");
  json["run"] = std::to_string(run);
  json["lanes"] = Json::object();
  for (const auto& [lane, nodes] : live.alarms) {
    Json since = Json::object();
    for (const auto& [node, k] : nodes) since[node] = k;
    json["lanes"][lane] = {{"alarm", !nodes.empty()}, {"since", std::move(since)}};
  }
  const std::string text = dumped(json);
  for (const auto& outbox : outboxes_) outbox->put({topic_of(run, "state"), text, true}, lasting);
}

void Announcer::forget(RunId run) {
  const std::lock_guard lock(mutex_);
  live_.erase(run);
  for (const auto& outbox : outboxes_) outbox->put({topic_of(run, "state"), "", true});
}

std::optional<std::string> Announcer::right(const std::string& topic, const std::string& text) const {
  const auto run = run_of(topic);
  if (!run || text.empty()) return std::nullopt;
  {
    const std::lock_guard lock(mutex_);
    if (live_.contains(*run)) return std::nullopt;
  }
  const auto state = options_.logged ? options_.logged(*run) : std::nullopt;
  if (!state) return "";
  Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) json = Json::object();
  if (json.value("state", Json()) == *state || !is_over(*state)) return std::nullopt;
  json["run"] = std::to_string(*run);
  json["state"] = *state;
  json["lanes"] = Json::object();
  return dumped(json);
}

Json Announcer::status() const {
  Json status = Json::object();
  for (const auto& outbox : outboxes_) status[outbox->name()] = outbox->status();
  return status;
}

}  // namespace vigil
