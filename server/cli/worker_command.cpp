// `vigil worker`: makes trials of campaigns elsewhere, until it is told to end.
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <thread>

#include "server/campaigns/request.hpp"
#include "server/cli/commands.hpp"
#include "server/cli/nats_options.hpp"

namespace vigil {
namespace {

struct WorkerCommand {
  NatsFlags nats;
  int threads = 0;
  std::string name;
};

std::string own_name() {
  char host[256] = {};
  gethostname(host, sizeof host - 1);
  return std::string(host) + "-" + std::to_string(getpid());
}

/// For tests: how long a trial takes beside itself, and which one kills the process.
void read_environment(WorkerOptions& options) {
  if (const char* sleep = std::getenv("VIGIL_TRIAL_SLEEP_MS"))
    options.sleep = std::chrono::milliseconds(std::strtol(sleep, nullptr, 10));
  if (const char* deadly = std::getenv("VIGIL_DEADLY_TRIAL")) options.deadly_trial = std::strtoll(deadly, nullptr, 10);
}

/// Sets `stop` at SIGINT or SIGTERM, as long as it lives.
class SignalWatch {
 public:
  explicit SignalWatch(std::atomic<bool>& stop) : thread_([this, &stop] { watch(stop); }) {}
  ~SignalWatch() {
    over_ = true;
    thread_.join();
  }
  SignalWatch(const SignalWatch&) = delete;
  SignalWatch& operator=(const SignalWatch&) = delete;
  static sigset_t ends() {
    sigset_t signals;
    sigemptyset(&signals);
    sigaddset(&signals, SIGINT);
    sigaddset(&signals, SIGTERM);
    return signals;
  }

 private:
  void watch(std::atomic<bool>& stop) const {
    const sigset_t signals = ends();
    const timespec moment{0, 100'000'000};
    while (!over_ && !stop) stop = sigtimedwait(&signals, nullptr, &moment) > 0;
  }
  std::atomic<bool> over_{false};
  std::thread thread_;
};

int work(WorkerCommand& command) {
  // Every thread inherits the mask: the signals wait for the watch below.
  const sigset_t signals = SignalWatch::ends();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  WorkerOptions options;
  options.name = command.name.empty() ? own_name() : command.name;
  options.threads = command.threads > 0 ? command.threads : all_cores();
  options.nats = command.nats.options;
  options.nats.name = "vigil worker " + options.name;
  options.fingerprint = own_fingerprint();
  read_environment(options);
  std::cout << "vigil " << version() << " worker " << options.name << " with " << options.threads
            << (options.threads == 1 ? " thread" : " threads") << std::endl;
  std::atomic<bool> stop{false};
  const SignalWatch watch(stop);
  try {
    run_nats_worker(options, stop);
  } catch (const std::runtime_error& error) {
    throw UserError(std::string("--nats: ") + error.what());
  }
  return kDone;
}

}  // namespace

void add_worker(CLI::App& app, Action& action) {
  auto command = std::make_shared<WorkerCommand>();
  CLI::App* sub = app.add_subcommand("worker", "make trials of campaigns that a broker offers");
  command->nats.add_to(*sub, "the broker, nats://HOST:PORT or tls://HOST:PORT; several with commas")->required();
  sub->add_option("--threads", command->threads, "trials at once, all cores without")->check(CLI::Range(1, 1024));
  sub->add_option("--name", command->name, "what campaigns call it; host and process without");
  sub->callback([command, &action] { action = [command] { return work(*command); }; });
}

}  // namespace vigil
