/// One run: a scenario, a seed, a version. Stepped by its caller, who owns time. No thread, clock, file or socket
/// inside.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/json.hpp"
#include "engine/run/frame.hpp"
#include "engine/scenario/scenario.hpp"

namespace vigil {

class Trace;

/// A live change, applied before tick k and part of the run: repeating the run with its commands repeats its samples.
/// body is one of
///   {"params":{"lanes.consensus.params.tau":0.02, …}}
///   {"attack":{"id":"a1","type":"dos_fdi","on":["link:*"],"from":…,"to":…,"params":{…}}}
///   {"end_attack":"a1"}
struct Command {
  std::int64_t k = 0;
  Json body;
};

/// One figure of a finished (or running) run. node, variant: empty where the contract says null.
struct MetricValue {
  std::string lane;
  std::string node;
  std::string name;
  std::string variant;
  double value = 0;      ///< NaN where there is none (null in JSON); 0 or 1 for a truth value
  bool boolean = false;  ///< value is a truth value: written as true or false
};

Json to_json(const MetricValue& metric);

/// Faults of one kind on one lane and node.
struct FaultCount {
  std::string lane;
  std::string node;  ///< empty: the whole lane
  std::string code;
  std::int64_t first = 0;  ///< tick
  std::int64_t last = 0;   ///< tick
  std::int64_t count = 0;
  bool stopped = false;  ///< this fault stopped its lane
  std::string detail;    ///< of the first
};

Json to_json(const FaultCount& fault);

struct RunOptions {
  std::uint64_t seed = 1;
  std::shared_ptr<const Trace> trace;  ///< takes the place of the world; may be null. One that grows is appended to
                                       ///< between two steps, on the thread that makes them
  std::vector<Command> commands;       ///< of an earlier run that is repeated
  Json designs = Json::object();       ///< {"<lane>":record} for every task of design_tasks(); see run/design.hpp
};

/// A value: a copy is a fork that goes on by itself.
class Run {
 public:
  /// Throws InputError where the scenario cannot be run as it is (sizes, ranges, a trace that is missing or does not
  /// fit).
  Run(const Scenario& scenario, RunOptions options);
  Run(const Run& other);
  Run(Run&& other) noexcept;
  Run& operator=(Run other) noexcept;
  ~Run();

  const Catalogue& catalogue() const;
  const Scenario& scenario() const;
  std::uint64_t seed() const;
  double dt() const;                          ///< s
  std::optional<std::int64_t> steps() const;  ///< last tick, empty: until stopped

  /// Emits frame 0 at the first call, then one tick a call. Does nothing once done(), nor on a trace that grows before
  /// the tick's row is there. Throws InputError where the first row of such a trace does not fit the scenario.
  void step(Sink& sink);
  std::int64_t tick() const;  ///< k of the newest frame, -1 before the first
  bool done() const;          ///< all steps made, the trace at its end, or every lane stopped

  /// Checks a command's body against the run as it stands, with the applied commands up to its tick, and gives it its
  /// tick (tick() + 1, or `at`) and, for an attack without one, an id. Throws InputError. Does not change the run.
  Command prepare(const Json& body, std::optional<std::int64_t> at = std::nullopt) const;
  /// Applies a prepared command before the next tick.
  void apply(const Command& command);

  std::vector<MetricValue> metrics() const;  ///< up to now
  std::vector<FaultCount> faults() const;
  std::vector<std::string> warnings() const;
  /// {"<lane>":{constants computed before the run}}
  Json design() const;
  /// {"nodes":[{"id","position":[x,y] or
  /// null}],"links":[{"id":"1-2","from":"1","to":"2"}],"lanes":[{"id","method","adversary"}],
  ///  "state":[{"name","unit"}]}: what a page needs to draw the run. Follows a live change of the graph.
  Json world() const;

 private:
  friend struct TrialAccess;
  struct State;
  void begin_anew();

  std::unique_ptr<State> state_;
};

}  // namespace vigil
