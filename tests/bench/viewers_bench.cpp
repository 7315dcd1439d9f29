/// What a run pays for being watched: CPU of its own thread a tick, with 100 viewers and with none; at full speed
/// (thinned to 60 frames a second), and paced so slowly that its data have left the processor's caches by the next
/// tick, as everybody else's work there has the more of them the more there is of it: then the part spent in the hub
/// tells what is the hub's. viewers_bench [viewers] [repeats]
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>
#include <vector>

#include "engine/run/run.hpp"
#include "server/front/front.hpp"
#include "server/hub/hub.hpp"
#include "tests/bench/yardsticks/sse_load.hpp"

namespace vigil::bench {
namespace {

/// How the run is driven: ticks a second (0: as fast as it can), for so many ticks.
struct Pace {
  double rate = 0;
  int ticks = 0;
};

/// Microseconds a tick: all, and the part spent in the hub.
struct Cost {
  double all = 0;
  double hub = 0;
};

double thread_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
}

class HubSink : public Sink {
 public:
  explicit HubSink(Hub& hub) : hub_(hub) {}
  void frame(const Frame& frame) override {
    const double start = thread_seconds();
    hub_.frame(1, frame);
    seconds += thread_seconds() - start;
  }
  void mark(const Mark& mark) override { hub_.mark(1, mark); }

  double seconds = 0;

 private:
  Hub& hub_;
};

/// Of this thread.
Cost drive(Run& run, HubSink& sink, const Pace& pace) {
  sink.seconds = 0;
  double used = 0;
  auto next = std::chrono::steady_clock::now();
  for (int i = 0; i < pace.ticks; ++i) {
    const double start = thread_seconds();
    run.step(sink);
    used += thread_seconds() - start;
    if (pace.rate > 0) {
      next += std::chrono::microseconds(static_cast<int>(1e6 / pace.rate));
      std::this_thread::sleep_until(next);
    }
  }
  return {used / pace.ticks * 1e6, sink.seconds / pace.ticks * 1e6};
}

std::vector<int> all_signals(const Catalogue& catalogue) {
  std::vector<int> ids;
  for (const Signal& signal : catalogue.all()) ids.push_back(signal.id);
  return ids;
}

/// A server with one run, in a process of its own: tells its port, then answers every number of ticks with the time
/// they took.
[[noreturn]] void serve(int in, int out) {
  Hub hub;
  Routes routes;
  Route stream;
  stream.method = "GET";
  stream.pattern = "/stream";
  stream.handler = [](const HttpRequest&, HttpResponse& response) { response.empty(404); };
  stream.stream = [](const HttpRequest&) { return StreamTarget{1, ""}; };
  routes.add(std::move(stream));
  FrontOptions options;
  options.port = 0;
  Front front(options, std::move(routes), hub);
  front.start();
  Run run(Scenario::preset("consensus").with("time.steps", nullptr), RunOptions());
  hub.open(1, run.catalogue(), {{"all", all_signals(run.catalogue())}}, run.dt());
  HubSink sink(hub);
  drive(run, sink, {50, 20});
  const int port = front.port();
  if (::write(out, &port, sizeof port) != sizeof port) _exit(1);
  Pace pace;
  while (::read(in, &pace, sizeof pace) == sizeof pace) {
    const Cost cost = drive(run, sink, pace);
    if (::write(out, &cost, sizeof cost) != sizeof cost) _exit(1);
  }
  _exit(0);
}

class Server {
 public:
  Server() {
    if (::pipe(to_) != 0 || ::pipe(from_) != 0) std::exit(1);
    process_ = ::fork();
    if (process_ == 0) {
      ::close(to_[1]);
      serve(to_[0], from_[1]);
    }
    if (::read(from_[0], &port_, sizeof port_) != sizeof port_) std::exit(1);
  }
  ~Server() {
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
  }
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  Cost measure(int viewers, const Pace& pace) const {
    Viewers crowd(viewers);
    crowd.connect(port_, "/stream");
    while (crowd.started() < viewers) crowd.receive(20);
    if (::write(to_[1], &pace, sizeof pace) != sizeof pace) std::exit(1);
    for (pollfd done{from_[0], POLLIN, 0}; ::poll(&done, 1, viewers > 0 ? 0 : -1) == 0;) crowd.receive(5);
    Cost cost;
    if (::read(from_[0], &cost, sizeof cost) != sizeof cost) std::exit(1);
    return cost;
  }

 private:
  int to_[2] = {};
  int from_[2] = {};
  pid_t process_ = 0;
  int port_ = 0;
};

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

void compare(const Server& server, const char* name, const Pace& pace, int viewers, int repeats, const char* bar) {
  std::vector<double> watched, alone, ratios, hub_watched, hub_alone;
  for (int i = 0; i < repeats; ++i) {
    const Cost without = server.measure(0, pace);
    const Cost with = server.measure(viewers, pace);
    alone.push_back(without.all);
    watched.push_back(with.all);
    hub_alone.push_back(without.hub);
    hub_watched.push_back(with.hub);
    ratios.push_back(with.all / without.all);
    std::fprintf(stderr, "  %s %d: %.1f us watched, %.1f us alone\n", name, i + 1, with.all, without.all);
  }
  std::printf(
      "viewers %s  %d watch %.1f  nobody %.1f us of the run's thread a tick  ratio %.3f  (%s; in the hub %.1f and %.1f "
      "us)\n",
      name, viewers, median(watched), median(alone), median(ratios), bar, median(hub_watched), median(hub_alone));
  std::fflush(stdout);
}

}  // namespace
}  // namespace vigil::bench

int main(int count, char** words) {
  using namespace vigil::bench;
  ::signal(SIGPIPE, SIG_IGN);
  const int viewers = count > 1 ? std::atoi(words[1]) : 100;
  const int repeats = count > 2 ? std::atoi(words[2]) : 7;
  const Server server;
  compare(server, "full speed", {0, 20'000}, viewers, repeats, "bar at most 1.05");
  compare(server, "paced", {50, 100}, viewers, repeats, "reported");
  return 0;
}
