/// A temporary folder, a run of random samples that remembers them, and waiting for what must come.
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <functional>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "db/maintenance.hpp"
#include "db/reader.hpp"
#include "db/writer.hpp"

namespace vigil::test {

class Folder {
 public:
  Folder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "vigil-db-XXXXXX").string();
    path_ = ::mkdtemp(pattern.data());
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  std::string file(const std::string& name) const { return path_ + "/" + name; }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// True as soon as `met` is; false after 30 s.
inline bool eventually(const std::function<bool()>& met) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (!met()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

inline constexpr WallTime kSecond = 1'000'000'000;
inline constexpr WallTime kDay = 86400 * kSecond;

inline Catalogue catalogue(int width) {
  Catalogue all;
  for (int i = 0; i < width; ++i) {
    Signal signal;
    signal.name = "lane.a.1.s" + std::to_string(i);
    signal.unit = "m";
    signal.lane = "a";
    signal.node = "1";
    all.add(signal);
  }
  return all;
}

inline RunRecord record(const std::string& scenario = "consensus") {
  RunRecord r;
  r.scenario = scenario;
  r.family = "consensus";
  r.document =
      Json::parse(R"({"title":{"en":"Eight cameras","zh":"八台相机"},"lanes":{"consensus":{"params":{"tau":0.02}}}})");
  r.document_hash = sha256_hex(r.document.dump());
  r.version = "0.1.0";
  r.dt = 0.5;
  return r;
}

/// Bits, so that NaN equals NaN and 0 differs from -0.
inline std::uint64_t bits(double value) {
  std::uint64_t out = 0;
  std::memcpy(&out, &value, sizeof out);
  return out;
}

/// Writes random frames and keeps a copy. Values are mostly numbers, now and then missing, infinite or denormal.
class Recorder {
 public:
  Recorder(LogWriter& writer, int width, LogSelection selection = {}, LogPolicy policy = LogPolicy::lossless,
           unsigned seed = 1)
      : writer_(writer), width_(width), random_(seed) {
    id = writer.create_run(record()).id;
    RunUpdate running;
    running.state = "running";
    writer.update(id, running);
    writer.set_signals(id, catalogue(width), selection, policy, 0.5);
  }

  Frame make(std::int64_t k) {
    Frame frame;
    frame.k = k;
    frame.t = static_cast<double>(k) * 0.5;
    for (int i = 0; i < width_; ++i) {
      const auto dice = random_() % 64;
      double value = normal_(random_);
      if (dice == 0) value = std::nan("");
      if (dice == 1) value = i % 2 == 0 ? INFINITY : -INFINITY;
      if (dice == 2) value = 5e-324;
      if (dice == 3) value = -0.0;
      if (i == width_ - 1) value = static_cast<double>(k / 700 % 2);
      frame.values.push_back(value);
    }
    return frame;
  }

  void write(std::int64_t from, std::int64_t to) {
    for (std::int64_t k = from; k <= to; ++k) {
      frames.push_back(make(k));
      writer_.frame(id, frames.back());
    }
  }

  void finish() {
    RunUpdate end;
    end.state = "finished";
    end.ended = 1;
    writer_.finish(id, end);
  }

  RunId id = 0;
  std::vector<Frame> frames;

 private:
  LogWriter& writer_;
  int width_;
  std::mt19937 random_;
  std::normal_distribution<double> normal_;
};

inline std::vector<int> ids(int width) {
  std::vector<int> all;
  for (int i = 0; i < width; ++i) all.push_back(i);
  return all;
}

/// Every logged row, as frames.
inline std::vector<Frame> read_all(const LogReader& reader, RunId run, const std::vector<int>& signals) {
  std::vector<Frame> frames;
  reader.rows(run, signals, 0, INT64_MAX, [&](std::int64_t k, double t, std::span<const double> values) {
    frames.push_back({k, t, std::vector<double>(values.begin(), values.end())});
    return true;
  });
  return frames;
}

inline void expect_same(const std::vector<Frame>& wanted, const std::vector<Frame>& got) {
  ASSERT_EQ(wanted.size(), got.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    ASSERT_EQ(wanted[i].k, got[i].k);
    ASSERT_EQ(bits(wanted[i].t), bits(got[i].t)) << "tick " << wanted[i].k;
    ASSERT_EQ(wanted[i].values.size(), got[i].values.size());
    for (std::size_t s = 0; s < wanted[i].values.size(); ++s) {
      ASSERT_EQ(bits(wanted[i].values[s]), bits(got[i].values[s])) << "tick " << wanted[i].k << ", signal " << s;
    }
  }
}

inline std::string all_of(const MaintenanceReport& report) {
  std::string text;
  for (const auto& sentence : report.sentences) text += sentence + "\n";
  return text;
}

/// A log whose clock the test sets.
class ClockedLog : public testing::Test {
 protected:
  LogOptions options() {
    LogOptions o;
    o.clock = [this] { return clock.load(); };
    return o;
  }
  std::string path() const { return folder.file("a.db"); }
  void end(RunId run, WallTime when, std::vector<std::string> tags = {}) {
    RunUpdate update;
    update.state = "finished";
    update.ended = when;
    update.tags = std::move(tags);
    writer.finish(run, update);
  }

  Folder folder;
  std::atomic<WallTime> clock{1000 * kDay};
  LogWriter writer{path(), options()};
  LogReader reader{path()};
};

}  // namespace vigil::test
