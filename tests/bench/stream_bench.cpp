/// Frames a server-CPU-second at many viewers: ours, and a bare epoll loop with frames of the same size and rate.
/// stream_bench [viewers] [seconds] [repeats]
/// stream_bench yardstick PORT HZ BYTES   only the yardstick, for another load program
/// stream_bench watch PORT PATH PID       only the load, on another server
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include "engine/run/run.hpp"
#include "server/front/front.hpp"
#include "server/hub/encode.hpp"
#include "server/hub/hub.hpp"
#include "tests/bench/yardsticks/sse_epoll.hpp"
#include "tests/bench/yardsticks/sse_load.hpp"

namespace vigil::bench {
namespace {

constexpr double kRate = 20;  // frames a second

/// What a run would publish, worked out beforehand: the engine's own time is not the stream's.
struct Recording {
  std::string name;
  Catalogue catalogue;
  std::vector<int> signals;
  std::vector<Frame> frames;

  std::size_t bytes() const {
    double total = 0;
    for (const Frame& frame : frames) {
      total += static_cast<double>(encode_frame("e12345678", frame.k, frame.t, 1, frame.values, signals)->size());
    }
    return static_cast<std::size_t>(total / static_cast<double>(frames.size()));
  }
};

Recording kilobyte() {
  Recording recording;
  recording.name = "1 kB";
  constexpr int kSignals = 112;  // of six digits each: 1 kB with everything around them
  for (int i = 0; i < kSignals; ++i) {
    Signal signal;
    signal.name = "s" + std::to_string(i);
    recording.signals.push_back(recording.catalogue.add(signal));
  }
  for (int k = 0; k < 200; ++k) {
    Frame frame;
    frame.k = k;
    frame.t = k / kRate;
    for (int i = 0; i < kSignals; ++i) frame.values.push_back(10 * std::sin(0.37 * k + i));
    recording.frames.push_back(std::move(frame));
  }
  return recording;
}

class Collect : public Sink {
 public:
  explicit Collect(std::vector<Frame>& frames) : frames_(frames) {}
  void frame(const Frame& frame) override { frames_.push_back(frame); }
  void mark(const Mark&) override {}

 private:
  std::vector<Frame>& frames_;
};

/// The demo's own overview: signals without a lane, those of a whole lane, and every node's error.
bool in_overview(const Signal& signal) {
  const auto ends_with_error = signal.name.size() > 6 && signal.name.ends_with(".error");
  if (!signal.lane.empty()) return signal.node.empty() || ends_with_error;
  return !signal.name.starts_with("sensor.") && signal.name.find(".injected.") == std::string::npos;
}

Recording overview() {
  Recording recording;
  recording.name = "overview";
  Run run(Scenario::preset("consensus"), RunOptions());
  recording.catalogue = run.catalogue();
  for (const Signal& signal : recording.catalogue.all()) {
    if (in_overview(signal)) recording.signals.push_back(signal.id);
  }
  Collect sink(recording.frames);
  while (!run.done() && recording.frames.size() < 200) run.step(sink);
  return recording;
}

/// Ours, in a process of its own: writes its port to `out`, then publishes until it is killed.
[[noreturn]] void serve_ours(const Recording& recording, int out) {
  Hub hub;
  Routes routes;
  Route stream;
  stream.method = "GET";
  stream.pattern = "/api/v1/runs/{id}/stream";
  stream.handler = [](const HttpRequest&, HttpResponse& response) { response.empty(404); };
  stream.stream = [](const HttpRequest& request) {
    return StreamTarget{request.id_param("id"), request.query_value("topic")};
  };
  routes.add(std::move(stream));
  FrontOptions options;
  options.port = 0;
  Front front(options, std::move(routes), hub);
  front.start();
  hub.open(1, recording.catalogue, {{"overview", recording.signals}}, 1 / kRate);
  const int port = front.port();
  if (::write(out, &port, sizeof port) != sizeof port) _exit(1);
  auto next = std::chrono::steady_clock::now();
  for (std::int64_t k = 0;; ++k) {
    Frame frame = recording.frames[static_cast<std::size_t>(k) % recording.frames.size()];
    frame.k = k;
    frame.t = static_cast<double>(k) / kRate;
    hub.frame(1, frame);
    next += std::chrono::microseconds(static_cast<int>(1e6 / kRate));
    std::this_thread::sleep_until(next);
  }
}

LoadResult measure_ours(const Recording& recording, const Load& load) {
  int pipe_ends[2];
  if (::pipe(pipe_ends) != 0) std::exit(1);
  const pid_t server = ::fork();
  if (server == 0) serve_ours(recording, pipe_ends[1]);
  int port = 0;
  if (::read(pipe_ends[0], &port, sizeof port) != sizeof port) std::exit(1);
  const LoadResult result = watch(port, "/api/v1/runs/1/stream", server, load);
  ::kill(server, SIGKILL);
  ::waitpid(server, nullptr, 0);
  ::close(pipe_ends[0]);
  ::close(pipe_ends[1]);
  return result;
}

LoadResult measure_yardstick(std::size_t bytes, const Load& load) {
  int port = 0;
  const int listener = listen_on_loopback(port);
  const pid_t server = ::fork();
  if (server == 0) serve_sse_epoll(listener, kRate, bytes);
  ::close(listener);
  const LoadResult result = watch(port, "/events", server, load);
  ::kill(server, SIGKILL);
  ::waitpid(server, nullptr, 0);
  return result;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

void compare(const Recording& recording, const Load& load, int repeats, const char* bar) {
  const std::size_t framed = recording.bytes();
  std::vector<double> ours, theirs, ratios;
  LoadResult mine, other;
  for (int i = 0; i < repeats; ++i) {
    mine = measure_ours(recording, load);
    other = measure_yardstick(framed - 8, load);  // a chunk's framing: 3 digits, two line breaks and a little
    ours.push_back(mine.frames_per_cpu_second());
    theirs.push_back(other.frames_per_cpu_second());
    ratios.push_back(ours.back() / theirs.back());
    std::fprintf(stderr,
                 "  %s %d: ours %.0f frames/s at %.3f CPU (%.0f B, %d viewers), yardstick %.0f at %.3f (%.0f B, %d)\n",
                 recording.name.c_str(), i + 1, mine.frames_per_second, mine.server_cpu, mine.bytes_per_frame,
                 mine.connected, other.frames_per_second, other.server_cpu, other.bytes_per_frame, other.connected);
  }
  std::printf(
      "stream %s  ours %.0f  yardstick %.0f frames per server-CPU-second  ratio %.2f  (%s; %d viewers, %zu B, %g Hz)\n",
      recording.name.c_str(), median(ours), median(theirs), median(ratios), bar, load.viewers, framed, kRate);
  std::fflush(stdout);
}

void raise_descriptor_limit() {
  rlimit limit{};
  getrlimit(RLIMIT_NOFILE, &limit);
  limit.rlim_cur = limit.rlim_max;
  setrlimit(RLIMIT_NOFILE, &limit);
}

}  // namespace
}  // namespace vigil::bench

int main(int count, char** words) {
  using namespace vigil::bench;
  ::signal(SIGPIPE, SIG_IGN);
  raise_descriptor_limit();
  const std::string first = count > 1 ? words[1] : "";
  if (first == "yardstick" && count == 5) {
    int port = std::atoi(words[2]);
    serve_sse_epoll(listen_on_loopback(port), std::atof(words[3]), static_cast<std::size_t>(std::atoi(words[4])));
  }
  Load load;
  if (first == "watch" && count == 5) {
    const LoadResult result = watch(std::atoi(words[2]), words[3], std::atoi(words[4]), load);
    std::printf("%.0f frames/s, %.0f frames per server-CPU-second, %.0f B\n", result.frames_per_second,
                result.frames_per_cpu_second(), result.bytes_per_frame);
    return 0;
  }
  if (count > 1) load.viewers = std::atoi(words[1]);
  if (count > 2) load.seconds = std::atof(words[2]);
  const int repeats = count > 3 ? std::atoi(words[3]) : 5;
  compare(kilobyte(), load, repeats, "bar 0.7");
  compare(overview(), load, repeats, "reported");
  return 0;
}
