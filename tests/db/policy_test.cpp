/// Who waits, what is dropped, and what never is.
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <condition_variable>
#include <mutex>

#include "tests/db/helpers.hpp"

namespace vigil::policy_test {
namespace {

using test::Folder;
using test::ids;
using test::Recorder;

/// A disk that can be made to stall.
class Gate {
 public:
  LogOptions options(std::size_t queue_bytes) {
    LogOptions o;
    o.queue_bytes = queue_bytes;
    o.before_commit = [this] {
      std::unique_lock lock(mutex_);
      ++waiting_;
      opened_.wait(lock, [&] { return open_; });
      --waiting_;
    };
    return o;
  }
  void shut() {
    const std::scoped_lock lock(mutex_);
    open_ = false;
  }
  void open() {
    const std::scoped_lock lock(mutex_);
    open_ = true;
    opened_.notify_all();
  }
  bool held() {
    const std::scoped_lock lock(mutex_);
    return waiting_ > 0;
  }

 private:
  std::mutex mutex_;
  std::condition_variable opened_;
  bool open_ = true;
  int waiting_ = 0;
};

Mark alarm(std::int64_t k) {
  Mark mark;
  mark.k = k;
  mark.type = MarkType::alarm;
  mark.code = "test";
  return mark;
}

TEST(Policy, ALiveRunNeverWaitsDropsSamplesButNoMarkAndSaysSo) {
  const Folder folder;
  Gate gate;
  LogWriter writer(folder.file("a.db"), gate.options(64 << 10));
  LogReader reader(folder.file("a.db"));
  Recorder run(writer, 8, {}, LogPolicy::live);
  run.write(0, 99);
  writer.flush();
  gate.shut();
  run.write(100, 4999);  // returns although nothing is written: that is the test
  for (std::int64_t k = 100; k < 5000; k += 7) writer.mark(run.id, alarm(k));
  EXPECT_GT(writer.health().dropped, 3000);
  EXPECT_LE(writer.health().queue_bytes, 2u * (64 << 10));
  gate.open();
  ASSERT_TRUE(test::eventually([&] { return writer.health().queue_bytes == 0; }));
  run.write(5000, 5999);
  run.finish();

  const auto gaps = reader.gaps(run.id);
  ASSERT_FALSE(gaps.empty());
  EXPECT_EQ(static_cast<std::int64_t>(gaps.size()), reader.run(run.id)->gaps);
  std::vector<Frame> wanted;
  for (const auto& frame : run.frames) {
    bool lost = false;
    for (const auto& gap : gaps) lost = lost || (frame.k >= gap.from && frame.k <= gap.to);
    if (!lost) wanted.push_back(frame);
  }
  EXPECT_EQ(writer.health().dropped, static_cast<std::int64_t>(run.frames.size() - wanted.size()));
  test::expect_same(wanted, test::read_all(reader, run.id, ids(8)));
  MarkFilter filter;
  filter.types = {MarkType::alarm};
  EXPECT_EQ(700u, reader.marks(run.id, filter).items.size());
  filter.types = {MarkType::note};
  const auto notes = reader.marks(run.id, filter).items;
  ASSERT_EQ(gaps.size(), notes.size());
  EXPECT_EQ("log_gap", notes[0].mark.code);
  EXPECT_EQ(gaps[0].from, notes[0].mark.k);
  const auto window = reader.samples(run.id, {0}, 0, 5999, 6000);
  EXPECT_EQ(gaps.size(), window.gaps.size());
  const auto report = check_log(folder.file("a.db"));
  EXPECT_TRUE(report.ok) << test::all_of(report);
}

TEST(Policy, AGapThatIsStillOpenAtTheEndIsRecorded) {
  const Folder folder;
  Gate gate;
  LogWriter writer(folder.file("a.db"), gate.options(32 << 10));
  LogReader reader(folder.file("a.db"));
  Recorder run(writer, 8, {}, LogPolicy::live);
  gate.shut();
  run.write(0, 2999);
  gate.open();
  run.finish();
  const auto gaps = reader.gaps(run.id);
  ASSERT_FALSE(gaps.empty());
  EXPECT_EQ(2999, gaps.back().to);
  EXPECT_TRUE(check_log(folder.file("a.db")).ok);
}

TEST(Policy, ALosslessRunWaitsAndLosesNothing) {
  const Folder folder;
  Gate gate;
  LogWriter writer(folder.file("a.db"), gate.options(32 << 10));
  LogReader reader(folder.file("a.db"));
  Recorder run(writer, 8);
  gate.shut();
  std::atomic<bool> done{false};
  std::thread stepping([&] {
    run.write(0, 9999);
    done = true;
  });
  ASSERT_TRUE(test::eventually([&] { return gate.held() && writer.health().queue_bytes > (16u << 10); }));
  EXPECT_FALSE(done);
  gate.open();
  stepping.join();
  run.finish();
  EXPECT_EQ(0, writer.health().dropped);
  EXPECT_TRUE(reader.gaps(run.id).empty());
  test::expect_same(run.frames, test::read_all(reader, run.id, ids(8)));
}

TEST(Policy, SwitchingToLiveFreesWhoWaits) {
  const Folder folder;
  Gate gate;
  LogWriter writer(folder.file("a.db"), gate.options(32 << 10));
  Recorder run(writer, 8);
  gate.shut();
  std::thread stepping([&] { run.write(0, 9999); });
  ASSERT_TRUE(test::eventually([&] { return writer.health().queue_bytes > (16u << 10); }));
  writer.set_policy(run.id, LogPolicy::live);
  stepping.join();
  EXPECT_GT(writer.health().dropped, 0);
  gate.open();
  run.finish();
  EXPECT_TRUE(check_log(folder.file("a.db")).ok);
}

TEST(Policy, FramesOfAnUnknownOrFinishedRunAreIgnored) {
  const Folder folder;
  LogWriter writer(folder.file("a.db"));
  LogReader reader(folder.file("a.db"));
  Recorder run(writer, 2);
  run.write(0, 9);
  run.finish();
  writer.frame(run.id, run.make(10));
  writer.frame(12345, run.make(10));
  writer.mark(12345, alarm(1));
  writer.flush();
  EXPECT_EQ(10u, test::read_all(reader, run.id, ids(2)).size());
  EXPECT_EQ(LogHealth::State::ok, writer.health().state);
}

#define REQUIRE_CHILD(condition) \
  if (!(condition)) {            \
    return __LINE__ & 0xff;      \
  }

int limit_files(rlim_t bytes) {
  rlimit limit{};
  getrlimit(RLIMIT_FSIZE, &limit);
  limit.rlim_cur = bytes;
  return setrlimit(RLIMIT_FSIZE, &limit);
}

/// Runs in a child: the limit is the process's.
int fill_the_disk(const std::string& path) {
  signal(SIGXFSZ, SIG_IGN);
  LogOptions options;
  options.queue_bytes = 256 << 10;
  options.patience_milliseconds = 200;
  LogWriter writer(path, options);
  LogReader reader(path);
  Recorder run(writer, 20, {}, LogPolicy::live);
  run.write(0, 999);
  writer.flush();
  REQUIRE_CHILD(limit_files(512 << 10) == 0);
  std::int64_t k = 1000;
  REQUIRE_CHILD(test::eventually([&] {
    run.write(k, k + 199);
    writer.mark(run.id, alarm(k));
    k += 200;
    return writer.health().state == LogHealth::State::degraded && writer.health().dropped > 0;
  }));
  REQUIRE_CHILD(!writer.health().sentence.empty());
  bool refused = false;
  try {
    writer.create_run(test::record("never"));
  } catch (const LogError& error) {
    refused = error.kind() == LogError::Kind::disk;
  }
  REQUIRE_CHILD(refused);
  REQUIRE_CHILD(reader.run(run.id)->k >= 999);
  REQUIRE_CHILD(limit_files(RLIM_INFINITY) == 0);
  REQUIRE_CHILD(test::eventually([&] { return writer.health().state == LogHealth::State::ok; }));
  run.write(k, k + 99);
  run.finish();
  MarkFilter filter;
  filter.types = {MarkType::alarm};
  REQUIRE_CHILD(static_cast<std::int64_t>(reader.marks(run.id, filter).items.size()) == (k - 1000) / 200);
  REQUIRE_CHILD(reader.run(run.id)->gaps > 0);
  REQUIRE_CHILD(reader.count(Query::parse("scenario:never", 0)) == 0);
  REQUIRE_CHILD(check_log(path).ok);
  return 0;
}

TEST(Policy, AFullDiskDegradesAndHeals) {
  const Folder folder;
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    int code = 1;
    try {
      code = fill_the_disk(folder.file("a.db"));
    } catch (...) {
      code = 2;
    }
    _exit(code);
  }
  int status = 0;
  ASSERT_EQ(child, waitpid(child, &status, 0));
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << "line (mod 256) " << WEXITSTATUS(status);
}

}  // namespace
}  // namespace vigil::policy_test
