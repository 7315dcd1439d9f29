#include "server/ingest/ingest_feed.hpp"

#include <algorithm>
#include <utility>

#include "engine/core/describe.hpp"
#include "engine/core/input_error.hpp"
#include "server/runs/refusal.hpp"

namespace vigil {
namespace {

constexpr std::size_t kWaitingCells = 2'000'000;  // of closed ticks that the run has not made: 16 MB
constexpr std::size_t kWaitingTicks = 10'000;
constexpr std::size_t kReasons = 5;

std::size_t room_for(const PushedColumns& columns) {
  return std::clamp<std::size_t>(kWaitingCells / std::max<std::size_t>(columns.names.size(), 1), 1, kWaitingTicks);
}

AssemblerLimits limits_of(const Scenario& scenario, const IngestOptions& options, std::size_t room) {
  AssemblerLimits limits;
  limits.advance = static_cast<std::int64_t>(room);
  limits.ahead = std::min(limits.ahead, limits.advance);
  limits.deadline = options.deadline;
  const Json& steps = scenario.document().at("time").at("steps");
  if (steps.is_number()) limits.last = steps.get<std::int64_t>();
  return limits;
}

std::vector<std::string> read_columns(const Json& list) {
  std::vector<std::string> columns;
  if (!list.is_array())
    throw InputError("/input/ingest/columns", "columns is " + shown(list) + "; expected an array of signal names",
                     "array of texts");
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (!list[i].is_string())
      throw InputError(child("/input/ingest/columns", i), "the column is " + shown(list[i]) + "; expected a name",
                       "text");
    columns.push_back(list[i].get<std::string>());
  }
  return columns;
}

Json tally_json(const Tally& tally) {
  return {{"accepted", tally.accepted}, {"duplicate", tally.duplicate}, {"late", tally.late}, {"beyond", tally.beyond}};
}

}  // namespace

bool is_ingest(const Json& input) { return input == "ingest" || (input.is_object() && input.contains("ingest")); }

IngestOptions read_ingest(const Json& input) {
  IngestOptions options;
  if (input == "ingest") return options;
  const Json& ingest = input.at("ingest");
  if (input.size() != 1 || !ingest.is_object())
    throw InputError("/input", "input is " + shown(input) + "; expected {\"ingest\":{…}}",
                     "\"ingest\" or {\"ingest\":{\"deadline\":s,\"columns\":[…],\"mqtt\":…}}");
  for (const auto& [key, value] : ingest.items()) {
    if (key == "columns") {
      options.further = read_columns(value);
    } else if (key == "mqtt") {
      options.plant = PlantOptions::from_json(value, "/input/ingest/mqtt");
    } else if (key != "deadline") {
      throw InputError(child("/input/ingest", key), "there is no " + in_quotes(key) + " here",
                       "deadline, columns, mqtt");
    } else {
      const double seconds = value.is_number() ? value.get<double>() : 0;
      if (!(seconds >= 0.001 && seconds <= 3600))
        throw InputError("/input/ingest/deadline",
                         "deadline is " + shown(value) + "; expected seconds from 0.001 to 3600", "0.001 to 3600");
      options.deadline = seconds;
    }
  }
  return options;
}

IngestFeed::IngestFeed(const Scenario& scenario, IngestOptions options)
    : options_(std::move(options)),
      columns_(pushed_columns(scenario, options_.further)),
      reader_(columns_),
      room_(room_for(columns_)),
      trace_(std::make_shared<Trace>(Trace::growing(columns_.names))),
      start_(options_.clock ? options_.clock() : std::chrono::steady_clock::now()),
      assembler_(columns_, limits_of(scenario, options_, room_)) {
  PlantOptions plant = options_.plant.value_or(PlantOptions());
  const double dt = scenario.document().at("time").at("dt").get<double>();
  if (plant.clock == PlantOptions::Clock::arrival)
    sampler_.emplace(
        columns_,
        SamplerLimits{.dt = dt, .hold = plant.hold, .room = room_, .last = limits_of(scenario, options_, room_).last});
  plant_reader_.emplace(columns_, reader_, std::move(plant), dt);
}

double IngestFeed::now() const { return seconds(options_.clock ? options_.clock() : std::chrono::steady_clock::now()); }

Json IngestFeed::to_json() const {
  if (options_.further.empty() && options_.deadline == 1 && !options_.plant) return "ingest";
  Json json{{"ingest", {{"deadline", options_.deadline}, {"columns", options_.further}}}};
  if (options_.plant) json["ingest"]["mqtt"] = options_.plant->to_json();
  return json;
}

void IngestFeed::add_ticks(Json& answer) const {
  answer["open"] = sampler_ ? sampler_->open() : assembler_.open();
  answer["closed"] = sampler_ ? sampler_->closed() : assembler_.closed();
}

Json IngestFeed::take(std::string_view type, const std::string& body) {
  const std::vector<IngestRow> rows = reader_.read(type, body);
  const std::lock_guard lock(mutex_);
  Json answer = tally_json(put(rows, now()));
  add_ticks(answer);
  return answer;
}

Tally IngestFeed::take(const TopicPlace& place, const std::string& payload, Time at) {
  const std::lock_guard lock(mutex_);
  return put(plant_reader_->read(place, payload), sampler_ ? std::max(seconds(at), latest_) : now());
}

void IngestFeed::refused(const std::string& sentence) {
  const std::lock_guard lock(mutex_);
  ++refused_;
  reasons_.push_back(sentence);
  if (reasons_.size() > kReasons) reasons_.pop_front();
}

/// mutex_ is held.
Tally IngestFeed::put(const std::vector<IngestRow>& rows, double now) {
  latest_ = std::max(latest_, now);
  const std::size_t waiting = sampler_ ? sampler_->ready() : assembler_.ready();
  if (sampler_ ? !sampler_->advance(now) : waiting >= room_)
    throw RunRefusal(RunRefusal::Kind::behind, "The run is behind: " + std::to_string(waiting) +
                                                   " ticks wait for it. Nothing was taken; send the same again later.");
  const Tally tally = sampler_ ? sampler_->take(rows, now) : assembler_.take(rows, now);
  total_.accepted += tally.accepted;
  total_.duplicate += tally.duplicate;
  total_.late += tally.late;
  total_.beyond += tally.beyond;
  return tally;
}

Json IngestFeed::status() const {
  const std::lock_guard lock(mutex_);
  Json answer = tally_json(total_);
  add_ticks(answer);
  answer["columns"] = columns_.names;
  answer["nodes"] = columns_.nodes;
  answer["deadline"] = options_.deadline;
  answer["waiting"] = sampler_ ? sampler_->ready() : assembler_.ready();
  answer["room"] = room_;
  if (!options_.plant) return answer;
  answer["mqtt"] = options_.plant->to_json();
  answer["refused"] = {{"messages", refused_}, {"newest", reasons_}};
  return answer;
}

bool IngestFeed::next() {
  std::vector<double> cells;
  {
    const std::lock_guard lock(mutex_);
    if (sampler_) {
      sampler_->advance(now());
    } else {
      assembler_.expire(now());
    }
    if ((sampler_ ? sampler_->ready() : assembler_.ready()) == 0) return false;
    cells = sampler_ ? sampler_->pop() : assembler_.pop();
  }
  trace_->append(cells);
  return true;
}

std::optional<IngestFeed::Time> IngestFeed::due() const {
  const std::lock_guard lock(mutex_);
  const auto due = sampler_ ? sampler_->due() : assembler_.due();
  if (!due) return std::nullopt;
  return start_ + std::chrono::duration_cast<Time::duration>(std::chrono::duration<double>(*due)) +
         std::chrono::microseconds(1);
}

}  // namespace vigil
