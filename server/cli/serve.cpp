// `vigil serve`: the server in the foreground, until it is told to end.
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <memory>

#include "engine/scenario/scenario.hpp"
#include "server/api/server.hpp"
#include "server/cli/commands.hpp"
#include "server/cli/mqtt_options.hpp"
#include "server/cli/nats_options.hpp"

namespace vigil {
namespace {

struct ServeCommand {
  ServerOptions server;
  std::string web, token_file;
  bool no_demo = false;
  double keep_days = -1, keep_gib = 20;
  NatsFlags nats;
  MqttFlags mqtt;
};

bool is_loopback(const std::string& host) {
  return host == "localhost" || host == "::1" || host == "[::1]" || host.rfind("127.", 0) == 0;
}

/// Beside the executable (an own folder, an installed tree's share/, or the source tree's two levels up), else where it
/// was to be installed.
std::optional<std::filesystem::path> find_page(const std::string& wanted) {
  namespace fs = std::filesystem;
  if (!wanted.empty()) {
    if (!fs::is_directory(wanted)) throw UserError("--web is " + wanted + "; expected the folder of the built page");
    return fs::path(wanted);
  }
  std::error_code error;
  const fs::path beside = fs::read_symlink("/proc/self/exe", error).parent_path();
  for (const fs::path& folder :
       {beside / "web", beside / "../share/vigil/web", beside / "../../web/dist", fs::path(VIGIL_INSTALLED_WEB)}) {
    if (fs::exists(folder / "index.html", error)) return fs::weakly_canonical(folder);
  }
  return std::nullopt;
}

std::optional<double> limit(double value, const char* flag) {
  if (value == -1) return std::nullopt;
  if (!std::isfinite(value) || value <= 0) throw UserError(std::string(flag) + " must be a number above 0");
  return value;
}

ServerOptions settled(const ServeCommand& command) {
  ServerOptions options = command.server;
  if (!command.token_file.empty()) {
    try {
      options.front.tokens = Tokens::from_file(command.token_file);
    } catch (const std::runtime_error& error) {
      throw UserError(std::string("--token-file: ") + error.what());
    }
  }
  if (!is_loopback(options.front.host) && !options.front.tokens.required()) {
    throw UserError("--host " + options.front.host +
                    " is open to other machines and needs --token-file FILE; without a token only 127.0.0.1, ::1 and "
                    "localhost are served");
  }
  options.web = find_page(command.web);
  options.demo = !command.no_demo;
  options.nats = command.nats.options;
  options.nats.name = "vigil serve";
  options.nats.say = [](const std::string& sentence) { spdlog::warn("NATS: {}", sentence); };
  options.mqtt = command.mqtt.settle(options.db);
  options.nats_prefix = command.mqtt.prefix_of(options.db);
  options.log.keep_days = limit(command.keep_days, "--keep-days");
  options.log.keep_gib = limit(command.keep_gib, "--keep-gib");
  return options;
}

std::string address(const FrontOptions& front, int port) {
  const bool six = front.host.find(':') != std::string::npos && front.host.front() != '[';
  return "http://" + (six ? "[" + front.host + "]" : front.host) + ":" + std::to_string(port);
}

int serve(const ServeCommand& command) {
  // Every thread inherits the mask: the signals wait for sigwait below.
  sigset_t ends;
  sigemptyset(&ends);
  sigaddset(&ends, SIGINT);
  sigaddset(&ends, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &ends, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
  spdlog::set_default_logger(spdlog::stderr_logger_mt("vigil"));

  const ServerOptions options = settled(command);
  Server server(options);
  try {
    server.start();
  } catch (const std::runtime_error& error) {
    throw UserError(error.what());
  }
  std::cout << "vigil " << version() << " listening on " << address(options.front, server.port()) << std::endl;
  int signal = 0;
  sigwait(&ends, &signal);
  spdlog::info("ending");
  server.stop();
  return kDone;
}

}  // namespace

void add_serve(CLI::App& app, Action& action) {
  auto command = std::make_shared<ServeCommand>();
  CLI::App* sub = app.add_subcommand("serve", "the server: page, API, runs and log");
  FrontOptions& front = command->server.front;
  sub->add_option("--host", front.host, "address to listen on, 127.0.0.1 without");
  sub->add_option("--port", front.port, "8080 without; 0 picks a free one")->check(CLI::Range(0, 65535));
  sub->add_option("--db", command->server.db, "the log's file, vigil.db without");
  sub->add_option("--web", command->web, "folder of the built page");
  sub->add_option("--token-file", command->token_file, "first line: the token; second: a read-only one");
  sub->add_option("--allow-host", front.allow_hosts, "a further name this server is called by")
      ->take_all()
      ->allow_extra_args(false);
  sub->add_option("--allow-webhook", command->server.runs.webhooks.allow,
                  "a host that alarms of runs may be sent to; none without")
      ->take_all()
      ->allow_extra_args(false);
  command->nats.add_to(*sub, "a broker's URL: campaigns can be made by its workers (vigil worker)");
  command->mqtt.add_to(*sub);
  sub->add_flag("--no-demo", command->no_demo, "start no demo run");
  sub->add_option("--keep-days", command->keep_days, "remove finished runs older than this");
  sub->add_option("--keep-gib", command->keep_gib,
                  "remove the oldest finished runs, then the oldest samples, above this size (20)");
  sub->add_option("--max-runs", command->server.runs.max_runs, "runs at once, 4 without; more wait")
      ->check(CLI::Range(1, 256));
  sub->add_option("--design-limit", command->server.runs.design.limit,
                  "seconds that finding a lane's gains may take, 120 without")
      ->check(CLI::Range(0.01, 1e6));
  sub->callback([command, &action] { action = [command] { return serve(*command); }; });
}

}  // namespace vigil
