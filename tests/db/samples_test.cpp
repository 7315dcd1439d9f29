/// What the writer took, the reader gives back: bit for bit, at any zoom, over every border.
#include <random>

#include "tests/db/helpers.hpp"

namespace vigil::samples_test {
namespace {

using test::expect_same;
using test::Folder;
using test::ids;
using test::read_all;
using test::Recorder;

TEST(Samples, RowsAreBitExactOverBlockBordersTailAndEnd) {
  const Folder folder;
  LogWriter writer(folder.file("a.db"));
  LogReader reader(folder.file("a.db"));
  Recorder run(writer, 7);
  std::int64_t next = 0;
  for (const std::int64_t last : {0, 1, 510, 511, 512, 513, 1023, 1024, 1700, 5000}) {
    run.write(next, last);
    next = last + 1;
    writer.flush();
    SCOPED_TRACE(last);
    expect_same(run.frames, read_all(reader, run.id, ids(7)));
    EXPECT_EQ(last, reader.run(run.id)->k);
  }
  run.finish();
  expect_same(run.frames, read_all(reader, run.id, ids(7)));
  EXPECT_EQ("finished", reader.run(run.id)->state);
  const auto report = check_log(folder.file("a.db"));
  EXPECT_TRUE(report.ok) << test::all_of(report);
  EXPECT_EQ(10, report.blocks);
}

TEST(Samples, ARunThatBeginsLateWithTimesOfItsOwnAndSomeSignals) {
  const Folder folder;
  LogWriter writer(folder.file("a.db"));
  LogReader reader(folder.file("a.db"));
  LogSelection selection;
  selection.signals = {1, 4};
  selection.every = 3;
  Recorder run(writer, 6, selection);
  std::vector<Frame> kept;
  for (std::int64_t k = 1400; k < 6000; ++k) {
    Frame frame = run.make(k);
    frame.t = 100.0 + static_cast<double>(k) * 0.1;
    writer.frame(run.id, frame);
    if (k % 3 == 0) kept.push_back({k, frame.t, {frame.values[4], std::nan(""), frame.values[1]}});
  }
  writer.flush();
  for (auto& frame : kept) frame.values[1] = std::numeric_limits<double>::quiet_NaN();
  expect_same(kept, read_all(reader, run.id, {4, 0, 1}));
  run.finish();
  expect_same(kept, read_all(reader, run.id, {4, 0, 1}));
  EXPECT_EQ((std::vector<int>{1, 4}), reader.logged_signals(run.id));
  EXPECT_EQ(6u, reader.signals(run.id).size());
  const auto window = reader.samples(run.id, {1}, 0, 100000, 10);
  EXPECT_EQ(1401, window.first);
  EXPECT_EQ(5997, window.last);
  EXPECT_FALSE(window.raw);
}

/// The extremes of [k of this bucket, k of the next) by brute force.
void expect_extremes(const std::vector<Frame>& frames, const SampleWindow& window, std::int64_t to) {
  for (const auto& series : window.series) {
    ASSERT_EQ(window.k.size(), series.lo.size());
    for (std::size_t b = 0; b < window.k.size(); ++b) {
      const std::int64_t end = b + 1 < window.k.size() ? window.k[b + 1] : to + 1;
      double lo = NAN, hi = NAN;
      for (const auto& frame : frames) {
        if (frame.k < window.k[b] || frame.k >= end) continue;
        const double value = frame.values[static_cast<std::size_t>(series.signal)];
        if (std::isnan(value)) continue;
        lo = std::isnan(lo) || value < lo ? value : lo;
        hi = std::isnan(hi) || value > hi ? value : hi;
      }
      const bool same_lo = lo == series.lo[b] || (std::isnan(lo) && std::isnan(series.lo[b]));
      const bool same_hi = hi == series.hi[b] || (std::isnan(hi) && std::isnan(series.hi[b]));
      ASSERT_TRUE(same_lo && same_hi) << "bucket " << b << " from tick " << window.k[b] << ": " << lo << ".." << hi
                                      << " but " << series.lo[b] << ".." << series.hi[b];
    }
  }
}

TEST(Samples, RandomWindowsAgreeWithBruteForce) {
  const Folder folder;
  LogWriter writer(folder.file("a.db"));
  LogReader reader(folder.file("a.db"));
  Recorder run(writer, 3);
  run.write(0, 20000);
  writer.flush();
  std::mt19937 random(5);
  for (int round = 0; round < 120; ++round) {
    if (round == 60) run.finish();
    std::int64_t from = random() % 20500, to = random() % 20500;
    if (from > to) std::swap(from, to);
    const int points = static_cast<int>(1 + random() % (round % 2 == 0 ? 60 : 3000));
    SCOPED_TRACE(testing::Message() << from << ".." << to << " in " << points);
    const auto window = reader.samples(run.id, {2, 0}, from, to, points);
    ASSERT_LE(window.k.size(), static_cast<std::size_t>(points) + 1);
    if (!window.k.empty()) {
      ASSERT_EQ(from, window.k.front());
    }
    if (window.raw) {
      for (std::size_t i = 0; i < window.k.size(); ++i) {
        const auto& frame = run.frames[static_cast<std::size_t>(from) + i];
        ASSERT_EQ(frame.k, window.k[i]);
        ASSERT_EQ(test::bits(frame.values[2]), test::bits(window.series[0].v[i]));
        ASSERT_EQ(test::bits(frame.values[0]), test::bits(window.series[1].v[i]));
      }
    } else {
      expect_extremes(run.frames, window, to);
    }
  }
}

TEST(Samples, ASpikeOfOneTickIsSeenAtEveryZoom) {
  const Folder folder;
  LogWriter writer(folder.file("a.db"));
  LogReader reader(folder.file("a.db"));
  Recorder run(writer, 1);
  constexpr std::int64_t kEnd = 300000, kSpike = 77777;
  Frame frame;
  frame.values.resize(1);
  for (frame.k = 0; frame.k <= kEnd; ++frame.k) {
    frame.t = static_cast<double>(frame.k) * 0.5;
    frame.values[0] = frame.k == kSpike ? 1e6 : 0.25;
    writer.frame(run.id, frame);
  }
  writer.flush();
  for (const int points : {1, 2, 3, 7, 30, 100, 333, 1000, 2000, 10000, 100000, 400000}) {
    const auto window = reader.samples(run.id, {0}, 0, kEnd, points);
    const auto& high = window.raw ? window.series[0].v : window.series[0].hi;
    int seen = 0;
    for (std::size_t b = 0; b < high.size(); ++b) {
      if (high[b] != 1e6) continue;
      ++seen;
      EXPECT_LE(window.k[b], kSpike);
      EXPECT_GT(window.k[b] + window.bucket, kSpike);
    }
    EXPECT_EQ(1, seen) << points;
  }
}

TEST(Samples, WhatIsNotThereIsEmptyNotWrong) {
  const Folder folder;
  LogWriter writer(folder.file("a.db"));
  LogReader reader(folder.file("a.db"));
  Recorder run(writer, 2);
  EXPECT_TRUE(reader.samples(run.id, {0}, 0, 100, 10).k.empty());
  EXPECT_EQ(-1, reader.samples(run.id, {0}, 0, 100, 10).last);
  run.write(0, 99);
  writer.flush();
  EXPECT_TRUE(reader.samples(run.id, {0}, 200, 300, 10).k.empty());
  EXPECT_TRUE(reader.samples(run.id, {0}, -10, -1, 10).k.empty());
  EXPECT_TRUE(reader.samples(run.id, {0}, 50, 40, 10).k.empty());
  EXPECT_EQ(100u, reader.samples(run.id, {0}, -5, INT64_MAX, 1000).k.size());
  const auto unknown = reader.samples(run.id, {17}, 0, 99, 1000);
  ASSERT_EQ(100u, unknown.series[0].v.size());
  EXPECT_TRUE(std::isnan(unknown.series[0].v[3]));
  EXPECT_THROW(reader.samples(999, {0}, 0, 1, 1), LogError);
  EXPECT_FALSE(reader.run(999));
}

TEST(Samples, ManyReadersWhileOneWrites) {
  const Folder folder;
  LogWriter writer(folder.file("a.db"));
  LogReader reader(folder.file("a.db"));
  Recorder run(writer, 4);
  std::atomic<bool> stop{false};
  std::atomic<int> failures{0};
  std::vector<std::thread> readers;
  for (int i = 0; i < 3; ++i) {
    readers.emplace_back([&] {
      std::int64_t before = -1;
      while (!stop) {
        const auto window = reader.samples(run.id, {0, 3}, 0, INT64_MAX, 1 << 20);
        for (std::size_t n = 0; n < window.k.size(); ++n) failures += window.k[n] != static_cast<std::int64_t>(n);
        const std::int64_t now = static_cast<std::int64_t>(window.k.size());
        failures += now < before;
        before = now;
      }
    });
  }
  for (int piece = 0; piece < 30; ++piece) {
    run.write(piece * 300, piece * 300 + 299);
    writer.flush();
  }
  stop = true;
  for (auto& thread : readers) thread.join();
  EXPECT_EQ(0, failures);
  expect_same(run.frames, read_all(reader, run.id, ids(4)));
}

}  // namespace
}  // namespace vigil::samples_test
