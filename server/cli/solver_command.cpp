// `vigil solve-sdp`: the child process of ChildSolver.
#include "server/cli/commands.hpp"
#include "server/synthesis/child_solver.hpp"

namespace vigil {

void add_solver(CLI::App& app, Action& action) {
  CLI::App* sub = app.add_subcommand("solve-sdp", "")->group("");
  sub->callback([&action] { action = [] { return solve_for_parent(); }; });
}

}  // namespace vigil
