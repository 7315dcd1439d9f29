#include "server/cli/cli.hpp"

#include <iostream>
#include <string>

#include "db/records.hpp"
#include "engine/core/describe.hpp"
#include "engine/core/input_error.hpp"
#include "engine/scenario/scenario.hpp"
#include "server/cli/commands.hpp"

namespace vigil {
namespace {

/// One line, whatever the text holds.
int complain(std::string sentence, int code) {
  for (char& c : sentence) {
    if (c == '\n' || c == '\r') c = ' ';
  }
  std::cerr << "vigil: " << sentence << std::endl;
  return code;
}

/// The command the user wrote, if it is none of ours: CLI11 would only say that one is missing.
std::string unknown_command(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return {};
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (command->get_name() == argv[1]) return {};
    if (!command->get_group().empty()) names.push_back(command->get_name());
  }
  return "there is no command " + in_quotes(argv[1]) + "; expected one of " + listed(names);
}

int carry_out(const Action& action) {
  try {
    return action();
  } catch (const UserError& error) {
    return complain(error.what(), kBadInput);
  } catch (const InputError& error) {
    const std::string pointer = error.problems().empty() ? "" : error.problems().front().pointer;
    const std::string what = error.what();
    return complain(pointer.empty() || what.find(pointer) != std::string::npos ? what : pointer + ": " + what,
                    kBadInput);
  } catch (const LogError& error) {
    return complain(error.what(), error.kind() == LogError::Kind::disk ? kInternalError : kBadInput);
  } catch (const std::exception& error) {
    return complain(std::string("internal error: ") + error.what(), kInternalError);
  }
}

}  // namespace

int run_command_line(int argc, char** argv) {
  CLI::App app("Secure state estimation under attack: simulate, compare, watch.", "vigil");
  app.set_version_flag("--version", "vigil " + std::string(version()));
  app.require_subcommand(1);
  Action action;
  add_serve(app, action);
  add_run(app, action);
  add_campaign(app, action);
  add_worker(app, action);
  add_compare(app, action);
  add_papers(app, action);
  add_synthesize(app, action);
  add_check(app, action);
  add_compatibility(app, action);
  add_lists(app, action);
  add_trace(app, action);
  add_identify(app, action);
  add_push(app, action);
  add_hands(app, action);
  add_db(app, action);
  add_solver(app, action);
  if (const std::string sentence = unknown_command(app, argc, argv); !sentence.empty())
    return complain(sentence, kBadInput);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    return complain(std::string(error.what()) + " (see vigil --help)", kBadInput);
  }
  return action ? carry_out(action) : kBadInput;
}

}  // namespace vigil
