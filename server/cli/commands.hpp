/// The subcommands: each adds its options to the app and keeps what to do when it was chosen.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <stdexcept>
#include <string>

namespace vigil {

/// What the user can mend: printed as one sentence, exit code 2.
class UserError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

inline constexpr int kDone = 0;
inline constexpr int kInternalError = 1;
inline constexpr int kBadInput = 2;
inline constexpr int kLaneStopped = 3;

/// Set by the chosen subcommand; its result is the exit code.
using Action = std::function<int()>;

void add_serve(CLI::App& app, Action& action);
void add_run(CLI::App& app, Action& action);
void add_campaign(CLI::App& app, Action& action);
void add_worker(CLI::App& app, Action& action);
void add_compare(CLI::App& app, Action& action);
void add_papers(CLI::App& app, Action& action);
void add_synthesize(CLI::App& app, Action& action);
void add_check(CLI::App& app, Action& action);
void add_compatibility(CLI::App& app, Action& action);
void add_lists(CLI::App& app, Action& action);
void add_trace(CLI::App& app, Action& action);
void add_identify(CLI::App& app, Action& action);
void add_push(CLI::App& app, Action& action);
void add_hands(CLI::App& app, Action& action);
void add_db(CLI::App& app, Action& action);
/// Not shown: what the server starts as its child.
void add_solver(CLI::App& app, Action& action);

}  // namespace vigil
