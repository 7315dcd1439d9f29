/// Gains for the command line: solved on the spot, each problem once.
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>

#include "server/runs/designs.hpp"
#include "server/synthesis/child_solver.hpp"

namespace vigil {

class GainFinder {
 public:
  /// --design-limit
  void add_to(CLI::App& command);

  /// The record of a task, whether it holds or not; of a problem that was solved before, that answer. Shows progress
  /// on standard error where that is a terminal.
  Json find(const DesignTask& task);
  /// Finds all that an order's run lacks, whether they hold or not. Throws InputError where its scenario cannot be
  /// designed for.
  void complete(RunOrder& order);
  /// The same for a run. Throws InputError with the reason at the first that it cannot have.
  void require(RunOrder& order);
  /// What was solved: {"seconds":of all,"lanes":{"<lane>":seconds}}; null where nothing was. A lane that was solved
  /// more than once, in a sweep, has the sum.
  Json timing() const;
  double limit() const { return limit_; }

 private:
  double limit_ = 120;  ///< s, of each solve
  std::map<std::string, Json> known_;
  std::map<std::string, double> seconds_;  ///< by lane
};

/// How long a solve took is no result: out of a run's "design", for the lanes of these records.
void drop_seconds(Json& design, const Json& designs);

}  // namespace vigil
