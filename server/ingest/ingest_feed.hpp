/// What is pushed into one run, between the requests that bring it and the thread that steps the run.
#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "engine/run/trace.hpp"
#include "server/ingest/assembler.hpp"
#include "server/ingest/plant_reader.hpp"
#include "server/ingest/sampler.hpp"

namespace vigil {

struct IngestOptions {
  double deadline = 1;                ///< s
  std::vector<std::string> further;   ///< columns beside readings, inputs and truth
  std::optional<PlantOptions> plant;  ///< topics feed the run, too
  /// Monotonic time; empty: the system's.
  std::function<std::chrono::steady_clock::time_point()> clock;
};

/// "ingest" or {"ingest":{"deadline":s,"columns":[…],"mqtt":…}}. Throws InputError below /input.
IngestOptions read_ingest(const Json& input);
/// True for an input of that form, right or wrong.
bool is_ingest(const Json& input);

class IngestFeed {
 public:
  using Time = std::chrono::steady_clock::time_point;
  /// Throws InputError where the scenario cannot be fed so.
  IngestFeed(const Scenario& scenario, IngestOptions options);

  const PushedColumns& columns() const { return columns_; }
  /// The options as POST /runs takes them.
  Json to_json() const;
  const std::optional<PlantOptions>& plant() const { return options_.plant; }

  // Any thread.

  /// {"accepted","duplicate","late","beyond","open":[k],"closed":k}. Throws what RowReader does, RunRefusal (behind)
  /// where the run has too many closed ticks before it: then nothing of the body was taken.
  Json take(std::string_view type, const std::string& body);
  /// A message of a plant that came at `at`, which never goes back. Throws what PlantReader does, RunRefusal (behind).
  Tally take(const TopicPlace& place, const std::string& payload, Time at);
  /// Counts a message that take() has refused, and keeps the newest few sentences.
  void refused(const std::string& sentence);
  /// {"columns","nodes","deadline","accepted","duplicate","late","beyond","open","closed","waiting","room"} since the
  /// start; waiting: closed ticks that the run has not made yet, room: how many there may be. Of a run that
  /// topics feed also "mqtt", its options, and "refused":{"messages","newest":[sentence]}.
  Json status() const;

  // The run's thread alone.

  std::shared_ptr<const Trace> trace() const { return trace_; }
  /// Appends the next closed tick to the trace; false where none is closed yet.
  bool next();
  /// When next() may be true without a further take().
  std::optional<Time> due() const;

 private:
  double now() const;
  double seconds(Time time) const { return std::chrono::duration<double>(time - start_).count(); }
  Tally put(const std::vector<IngestRow>& rows, double now);
  void add_ticks(Json& answer) const;

  const IngestOptions options_;
  const PushedColumns columns_;
  const RowReader reader_;
  const std::size_t room_;
  const std::shared_ptr<Trace> trace_;
  const Time start_;
  mutable std::mutex mutex_;
  Assembler assembler_;
  std::optional<Sampler> sampler_;  ///< in its place, where the plant's clock is "arrival"
  std::optional<PlantReader> plant_reader_;
  double latest_ = 0;  ///< s: newest time that rows came at
  Tally total_;
  std::int64_t refused_ = 0;
  std::deque<std::string> reasons_;
};

}  // namespace vigil
