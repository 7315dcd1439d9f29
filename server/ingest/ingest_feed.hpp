/// What is pushed into one run, between the requests that bring it and the thread that steps the run.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "engine/run/trace.hpp"
#include "server/ingest/assembler.hpp"

namespace vigil {

struct IngestOptions {
  double deadline = 1;               ///< s
  std::vector<std::string> further;  ///< columns beside readings, inputs and truth
  /// Monotonic time; empty: the system's.
  std::function<std::chrono::steady_clock::time_point()> clock;
};

/// "ingest" or {"ingest":{"deadline":s,"columns":[…]}}. Throws InputError below /input.
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

  // Any thread.

  /// {"accepted","duplicate","late","beyond","open":[k],"closed":k}. Throws what RowReader does, RunRefusal (behind)
  /// where the run has too many closed ticks before it: then nothing of the body was taken.
  Json take(std::string_view type, const std::string& body);
  /// {"columns","nodes","deadline","accepted","duplicate","late","beyond","open","closed","waiting","room"} since the
  /// start; waiting: closed ticks that the run has not made yet, room: how many there may be.
  Json status() const;

  // The run's thread alone.

  std::shared_ptr<const Trace> trace() const { return trace_; }
  /// Appends the next closed tick to the trace; false where none is closed yet.
  bool next();
  /// When next() may be true without a further take().
  std::optional<Time> due() const;

 private:
  double now() const;
  void add_ticks(Json& answer) const;

  const IngestOptions options_;
  const PushedColumns columns_;
  const RowReader reader_;
  const std::size_t room_;
  const std::shared_ptr<Trace> trace_;
  const Time start_;
  mutable std::mutex mutex_;
  Assembler assembler_;
  Tally total_;
};

}  // namespace vigil
