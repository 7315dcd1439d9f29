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
                     "\"ingest\" or {\"ingest\":{\"deadline\":s,\"columns\":[…]}}");
  for (const auto& [key, value] : ingest.items()) {
    if (key == "columns") {
      options.further = read_columns(value);
    } else if (key != "deadline") {
      throw InputError(child("/input/ingest", key), "there is no " + in_quotes(key) + " here", "deadline, columns");
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
      assembler_(columns_, limits_of(scenario, options_, room_)) {}

double IngestFeed::now() const {
  const Time time = options_.clock ? options_.clock() : std::chrono::steady_clock::now();
  return std::chrono::duration<double>(time - start_).count();
}

Json IngestFeed::to_json() const {
  if (options_.further.empty() && options_.deadline == 1) return "ingest";
  return {{"ingest", {{"deadline", options_.deadline}, {"columns", options_.further}}}};
}

void IngestFeed::add_ticks(Json& answer) const {
  answer["open"] = assembler_.open();
  answer["closed"] = assembler_.closed();
}

Json IngestFeed::take(std::string_view type, const std::string& body) {
  const std::vector<IngestRow> rows = reader_.read(type, body);
  const std::lock_guard lock(mutex_);
  if (assembler_.ready() >= room_)
    throw RunRefusal(RunRefusal::Kind::behind, "The run is behind: " + std::to_string(assembler_.ready()) +
                                                   " ticks wait for it. Nothing was taken; send the same again later.");
  const Tally tally = assembler_.take(rows, now());
  total_.accepted += tally.accepted;
  total_.duplicate += tally.duplicate;
  total_.late += tally.late;
  total_.beyond += tally.beyond;
  Json answer = tally_json(tally);
  add_ticks(answer);
  return answer;
}

Json IngestFeed::status() const {
  const std::lock_guard lock(mutex_);
  Json answer = tally_json(total_);
  add_ticks(answer);
  answer["columns"] = columns_.names;
  answer["nodes"] = columns_.nodes;
  answer["deadline"] = options_.deadline;
  answer["waiting"] = assembler_.ready();
  answer["room"] = room_;
  return answer;
}

bool IngestFeed::next() {
  std::vector<double> cells;
  {
    const std::lock_guard lock(mutex_);
    assembler_.expire(now());
    if (assembler_.ready() == 0) return false;
    cells = assembler_.pop();
  }
  trace_->append(cells);
  return true;
}

std::optional<IngestFeed::Time> IngestFeed::due() const {
  const std::lock_guard lock(mutex_);
  const auto seconds = assembler_.due();
  if (!seconds) return std::nullopt;
  return start_ + std::chrono::duration_cast<Time::duration>(std::chrono::duration<double>(*seconds)) +
         std::chrono::microseconds(1);
}

}  // namespace vigil
