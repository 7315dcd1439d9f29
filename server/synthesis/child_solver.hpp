/// DSDP in a process of its own, so that a solve that runs away or crashes takes nothing else along.
#pragma once

#include <atomic>
#include <string>

#include "engine/linalg/sdp.hpp"

namespace vigil {

/// Starts `EXECUTABLE solve-sdp` for every problem and speaks JSON with it. One solve at a time in a process, whoever
/// asks: others wait for their turn. Whatever becomes of the child (killed, crashed, talking nonsense, silent) is a
/// verdict with a sentence, never an exception, and no solve outlasts its limit. The child dies with this process, or
/// with the thread that asked.
class ChildSolver : public SdpSolver {
 public:
  /// `executable`: of Vigil; empty is the one that runs now.
  explicit ChildSolver(std::string executable = {});
  ~ChildSolver() override;
  ChildSolver(const ChildSolver&) = delete;
  ChildSolver& operator=(const ChildSolver&) = delete;

  std::string_view name() const override { return "DSDP"; }
  /// limit: seconds from the child's start to its end by force. The child itself is asked to stop a little earlier, so
  /// that it may still give what it has.
  SdpSolution solve(const SdpProblem& problem, double limit) override;
  /// From any thread: ends the solve that goes on and all later ones of this object; their verdict is failed.
  void cancel();
  bool cancelled() const { return cancelled_; }

 private:
  SdpSolution ask_child(const SdpProblem& problem, double limit);

  const std::string executable_;
  std::atomic<bool> cancelled_{false};
  int wake_ = -1;  ///< an eventfd, readable once cancelled
};

/// What `vigil solve-sdp` does: a problem on standard input, a solution on standard output. The exit code.
int solve_for_parent();

}  // namespace vigil
