/// The log's speed: LogWriter, lossless, a run at full speed, against raw chunk inserts with FULL. The same samples for
/// both, drawn beforehand.
///
///   log_bench [--repeats N] [--ticks N] [--dir FOLDER] [--draw]
///
/// --draw draws the yardstick's samples inside its measured time and measures nothing else, as the yardstick it is
/// modelled on does.
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <random>

#include "db/writer.hpp"
#include "tests/bench/yardsticks/raw_chunks.hpp"

namespace vigil::bench {
namespace {

constexpr int kSignals = 40;
constexpr std::int64_t kDrawn = 8192;

double wall() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

double cpu() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_usec) * 1e-6;
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// Half noise with a full mantissa, a quarter smooth, the rest thresholds and flags.
double draw(int signal, std::int64_t k, std::mt19937_64& random) {
  static std::normal_distribution<double> normal;
  const double t = static_cast<double>(k);
  switch (signal % 8) {
    case 0:
    case 1:
    case 2:
    case 3:
      return std::sin(t * 1e-3 * (signal + 1)) + 0.05 * normal(random);
    case 4:
    case 5:
      return std::sin(t * 1e-3 * (signal + 1));
    case 6:
      return 3.5 + 0.25 * static_cast<double>((k / 200) % 3);
    default:
      return (k / 500) % 7 == 0 ? 1.0 : 0.0;
  }
}

struct Speed {
  double wall = 0, cpu = 0;  ///< samples per second
};

void remove_log(const std::string& path) {
  for (const char* suffix : {"", "-wal", "-shm", ".lock"}) std::filesystem::remove(path + suffix);
}

template <class Work>
Speed measure(std::int64_t ticks, Work work) {
  const double wall_before = wall(), cpu_before = cpu();
  work();
  const double samples = static_cast<double>(ticks) * kSignals;
  return {samples / (wall() - wall_before), samples / (cpu() - cpu_before)};
}

Speed measure_ours(const std::string& path, std::int64_t ticks, const std::vector<Frame>& frames) {
  remove_log(path);
  Catalogue catalogue;
  for (int s = 0; s < kSignals; ++s) {
    Signal signal;
    signal.name = "s" + std::to_string(s);
    catalogue.add(signal);
  }
  Speed speed;
  {
    LogWriter writer(path);
    RunRecord record;
    record.scenario = "bench";
    record.document = Json::object();
    const RunId run = writer.create_run(record).id;
    writer.set_signals(run, catalogue, {}, LogPolicy::lossless, 0.05);
    Frame frame;
    speed = measure(ticks, [&] {
      for (std::int64_t k = 0; k < ticks; ++k) {
        frame.values = frames[static_cast<std::size_t>(k % kDrawn)].values;
        frame.k = k;
        frame.t = static_cast<double>(k) * 0.05;
        writer.frame(run, frame);
      }
      RunUpdate end;
      end.state = "finished";
      writer.finish(run, end);
    });
  }
  remove_log(path);
  return speed;
}

Speed measure_yardstick(const std::string& path, std::int64_t ticks, const std::vector<Frame>& frames) {
  remove_log(path);
  Speed speed;
  {
    RawChunks log(path, kSignals);
    speed = measure(ticks, [&] {
      for (std::int64_t k = 0; k < ticks; ++k) log.tick(k, frames[static_cast<std::size_t>(k % kDrawn)].values.data());
    });
  }
  remove_log(path);
  return speed;
}

Speed measure_drawing_yardstick(const std::string& path, std::int64_t ticks) {
  remove_log(path);
  Speed speed;
  {
    RawChunks log(path, kSignals);
    std::mt19937_64 random(1);
    double values[kSignals];
    speed = measure(ticks, [&] {
      for (std::int64_t k = 0; k < ticks; ++k) {
        for (int s = 0; s < kSignals; ++s) values[s] = draw(s, k, random);
        log.tick(k, values);
      }
    });
  }
  remove_log(path);
  return speed;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

std::vector<Frame> drawn_frames() {
  std::mt19937_64 random(1);
  std::vector<Frame> frames(kDrawn);
  for (std::int64_t k = 0; k < kDrawn; ++k) {
    for (int s = 0; s < kSignals; ++s) frames[static_cast<std::size_t>(k)].values.push_back(draw(s, k, random));
  }
  return frames;
}

int run(int repeats, std::int64_t ticks, const std::string& folder, bool drawing) {
  const std::string ours_path = folder + "/vigil-bench-ours.db", yard_path = folder + "/vigil-bench-yardstick.db";
  if (drawing) {
    const Speed speed = measure_drawing_yardstick(yard_path, ticks);
    std::printf("log  yardstick with drawing %.0f samples/s\n", speed.wall);
    return 0;
  }
  const auto frames = drawn_frames();
  std::vector<double> ours, yardstick, ratio, cpu_ratio;
  for (int i = 0; i < repeats; ++i) {
    const Speed a = measure_ours(ours_path, ticks, frames), b = measure_yardstick(yard_path, ticks, frames);
    ours.push_back(a.wall);
    yardstick.push_back(b.wall);
    ratio.push_back(a.wall / b.wall);
    cpu_ratio.push_back(a.cpu / b.cpu);
  }
  std::printf("log  ours %.0f samples/s  yardstick %.0f samples/s  ratio %.2f  (bar 0.5)\n", median(ours),
              median(yardstick), median(ratio));
  std::printf("log  samples per CPU second: ratio %.2f (ours compresses, checks and queues)\n", median(cpu_ratio));
  return median(ratio) >= 0.5 ? 0 : 1;
}

}  // namespace
}  // namespace vigil::bench

int main(int argc, char** argv) {
  int repeats = 5;
  std::int64_t ticks = 512 * 160;
  std::string folder = ".";
  bool drawing = false;
  for (int i = 1; i < argc; ++i) {
    const bool more = i + 1 < argc;
    if (std::strcmp(argv[i], "--draw") == 0) {
      drawing = true;
    } else if (more && std::strcmp(argv[i], "--repeats") == 0) {
      repeats = std::max(1, std::atoi(argv[++i]));
    } else if (more && std::strcmp(argv[i], "--ticks") == 0) {
      ticks = std::max(512LL, std::atoll(argv[++i]));
    } else if (more && std::strcmp(argv[i], "--dir") == 0) {
      folder = argv[++i];
    } else {
      std::fprintf(stderr, "log_bench [--repeats N] [--ticks N] [--dir FOLDER] [--draw]\n");
      return 2;
    }
  }
  return vigil::bench::run(repeats, ticks / 512 * 512, folder, drawing);
}
