/// What a stalled disk costs a paced run: thread time per tick of the default experiment, logged live, with the disk at
/// work and with a disk that does not answer. Interleaved, median of seven.
///
///   stall_bench [--repeats N] [--ticks N] [--dir FOLDER]
#include <time.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <thread>

#include "db/writer.hpp"
#include "engine/run/run.hpp"

namespace vigil::bench {
namespace {

constexpr auto kTick = std::chrono::milliseconds(2);

double thread_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
}

class Disk {
 public:
  void commit() {
    std::unique_lock lock(mutex_);
    opened_.wait(lock, [&] { return !stalled_; });
  }
  void set_stalled(bool stalled) {
    const std::scoped_lock lock(mutex_);
    stalled_ = stalled;
    opened_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable opened_;
  bool stalled_ = false;
};

class LogSink : public Sink {
 public:
  LogSink(LogWriter& writer, RunId run) : writer_(writer), run_(run) {}
  void frame(const Frame& frame) override { writer_.frame(run_, frame); }
  void mark(const Mark& mark) override { writer_.mark(run_, mark); }

 private:
  LogWriter& writer_;
  RunId run_;
};

/// Seconds of thread time per tick.
double measure(const Scenario& scenario, const std::string& path, int ticks, bool stalled) {
  Disk disk;
  LogOptions options;
  // Small, so that a stalled disk fills it within the measurement and frames are dropped as well.
  options.queue_bytes = 512u << 10;
  options.before_commit = [&] { disk.commit(); };
  double spent = 0;
  {
    LogWriter writer(path, options);
    Run run(scenario, {});
    RunRecord record;
    record.scenario = scenario.id();
    record.document = scenario.document();
    const RunId id = writer.create_run(record).id;
    writer.set_signals(id, run.catalogue(), {}, LogPolicy::live, run.dt());
    writer.flush();
    LogSink sink(writer, id);
    for (int i = 0; i < 200; ++i) run.step(sink);
    disk.set_stalled(stalled);
    auto due = std::chrono::steady_clock::now();
    for (int i = 0; i < ticks; ++i) {
      std::this_thread::sleep_until(due += kTick);
      const double before = thread_seconds();
      run.step(sink);
      spent += thread_seconds() - before;
    }
    disk.set_stalled(false);
  }
  for (const char* suffix : {"", "-wal", "-shm", ".lock"}) std::filesystem::remove(path + suffix);
  return spent / ticks;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

int run(int repeats, int ticks, const std::string& folder) {
  const Scenario scenario = Scenario::preset("consensus").with("time.steps", nullptr);
  const std::string path = folder + "/vigil-bench-stall.db";
  std::vector<double> healthy, stalled, ratio, noise;
  for (int i = 0; i < repeats; ++i) {
    // Stalled between two healthy ones: a slow drift of the machine favours neither, and the two tell the noise.
    const double before = measure(scenario, path, ticks, false);
    const double without_disk = measure(scenario, path, ticks, true);
    const double after = measure(scenario, path, ticks, false);
    healthy.push_back((before + after) / 2);
    stalled.push_back(without_disk);
    ratio.push_back(2 * without_disk / (before + after));
    noise.push_back(std::max(before, after) / std::min(before, after));
  }
  std::printf(
      "stall  disk at work %.1f us/tick  disk stalled %.1f us/tick  ratio %.3f  (bar 1.05; two runs alike differ by "
      "%.3f)\n",
      median(healthy) * 1e6, median(stalled) * 1e6, median(ratio), median(noise));
  return median(ratio) <= 1.05 ? 0 : 1;
}

}  // namespace
}  // namespace vigil::bench

int main(int argc, char** argv) {
  int repeats = 7, ticks = 700;
  std::string folder = ".";
  for (int i = 1; i < argc; ++i) {
    const bool more = i + 1 < argc;
    if (more && std::strcmp(argv[i], "--repeats") == 0) {
      repeats = std::max(1, std::atoi(argv[++i]));
    } else if (more && std::strcmp(argv[i], "--ticks") == 0) {
      ticks = std::max(1, std::atoi(argv[++i]));
    } else if (more && std::strcmp(argv[i], "--dir") == 0) {
      folder = argv[++i];
    } else {
      std::fprintf(stderr, "stall_bench [--repeats N] [--ticks N] [--dir FOLDER]\n");
      return 2;
    }
  }
  return vigil::bench::run(repeats, ticks, folder);
}
