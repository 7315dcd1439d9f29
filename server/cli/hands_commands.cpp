// `vigil attack`, `tune`, `fork`, `bundle`: hands in a run of a server that goes on.
#include <iostream>
#include <memory>
#include <optional>
#include <vector>

#include "server/cli/api_client.hpp"
#include "server/cli/commands.hpp"
#include "server/cli/files.hpp"
#include "server/cli/scenario_options.hpp"

namespace vigil {
namespace {

struct AttackCommand {
  ServerAddress server;
  std::string run, type, id, end, params = "{}";
  std::vector<std::string> on;
  std::optional<std::int64_t> from, to;
};

Json parsed(const std::string& text, const std::string& what) {
  Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) throw UserError(what + " is " + text + "; expected a JSON object");
  return json;
}

int attack(const AttackCommand& command) {
  const std::string path = run_path(command.run) + "/attacks";
  if (command.type.empty() == command.end.empty())
    throw UserError("expected either --type, to start, or --end, to stop");
  ApiClient client(command.server);
  if (!command.end.empty()) {
    client.remove(path + "/" + command.end);
    return kDone;
  }
  Json body{{"type", command.type}, {"on", command.on}, {"params", parsed(command.params, "--params")}};
  if (!command.id.empty()) body["id"] = command.id;
  if (command.from) body["from"] = *command.from;
  if (command.to) body["to"] = *command.to;
  std::cout << client.post(path, body).dump() << std::endl;
  return kDone;
}

struct TuneCommand {
  ServerAddress server;
  std::string run;
  std::vector<std::string> sets;
};

int tune(const TuneCommand& command) {
  Json params = Json::object();
  for (const std::string& text : command.sets) {
    auto [path, value] = parse_set(text);
    params[path] = std::move(value);
  }
  ApiClient(command.server).patch(run_path(command.run), {{"params", std::move(params)}});
  return kDone;
}

struct ForkCommand {
  ServerAddress server;
  std::string run, patch, pace;
  std::int64_t k = 0;
};

int fork(const ForkCommand& command) {
  Json body{{"k", command.k},
            {"patch", command.patch.empty() ? Json::object() : parsed(read_text(command.patch), "the patch")}};
  if (command.pace == "max") {
    body["pace"] = "max";
  } else if (!command.pace.empty()) {
    body["pace"] = Json::parse(command.pace, nullptr, false);
    if (!body["pace"].is_number()) throw UserError("--pace is " + command.pace + "; expected max or ticks per second");
  }
  const Json made = ApiClient(command.server).post(run_path(command.run) + "/fork", body);
  std::cout << made.at("id").get<std::string>() << std::endl;
  return kDone;
}

struct BundleCommand {
  ServerAddress server;
  std::string run, out = "-";
};

int bundle(const BundleCommand& command) {
  write_text(command.out, ApiClient(command.server).get_text(run_path(command.run) + "/bundle"));
  return kDone;
}

template <class Command>
CLI::App* add(CLI::App& app, Action& action, const char* name, const char* what, int (*carry_out)(const Command&),
              std::shared_ptr<Command>& command) {
  command = std::make_shared<Command>();
  CLI::App* sub = app.add_subcommand(name, what);
  sub->add_option("RUN", command->run, "its id on the server")->required();
  command->server.add_to(*sub);
  sub->callback([command, carry_out, &action] { action = [command, carry_out] { return carry_out(*command); }; });
  return sub;
}

}  // namespace

void add_hands(CLI::App& app, Action& action) {
  std::shared_ptr<AttackCommand> attacked;
  CLI::App* sub = add(app, action, "attack", "start or stop an attack in a run of a server", attack, attacked);
  sub->add_option("--type", attacked->type, "start one: an attack of `vigil methods`");
  sub->add_option("--on", attacked->on,
                  "a place such as link:2-3, sensor:1 or actuator:1; several times; link:* without")
      ->allow_extra_args(false)
      ->default_val(std::vector<std::string>{"link:*"});
  sub->add_option("--id", attacked->id, "its name; one that is free without");
  sub->add_option("--from", attacked->from, "first tick; the next without");
  sub->add_option("--to", attacked->to, "last tick; until it is stopped without");
  sub->add_option("--params", attacked->params, "a JSON object");
  sub->add_option("--end", attacked->end, "stop the attack of this name instead");

  std::shared_ptr<TuneCommand> tuned;
  add(app, action, "tune", "change live parameters of a run of a server", tune, tuned)
      ->add_option("PATH=JSON", tuned->sets, "lanes.consensus.params.tau=0.02")
      ->required();

  std::shared_ptr<ForkCommand> forked;
  sub = add(app, action, "fork", "a new run that has the past of another up to a tick; prints its id", fork, forked);
  sub->add_option("--k", forked->k, "the last tick they share")->required();
  sub->add_option("--patch", forked->patch, "a JSON Merge Patch of what comes after, in a file");
  sub->add_option("--pace", forked->pace, "max or ticks per second; the other's without");

  std::shared_ptr<BundleCommand> bundled;
  add(app, action, "bundle",
      "document, seed, commands, gains, frames and metrics of a run in one file, for `vigil run`", bundle, bundled)
      ->add_option("--out", bundled->out, "a file; standard output without");
}

}  // namespace vigil
