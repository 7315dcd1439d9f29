/// kill -9 in the middle: nothing acknowledged is lost, nothing is torn.
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>

#include "tests/db/helpers.hpp"

namespace vigil::kill_test {
namespace {

using test::Folder;
using test::Recorder;

constexpr int kWidth = 9;

struct Acknowledged {
  std::int64_t commands = 0;  ///< each returned
  std::int64_t flushed = -1;  ///< tick up to which a flush returned
};

/// In the child, for ever: frames, commands, flushes; each acknowledgement goes through the pipe.
[[noreturn]] void write_until_killed(const std::string& path, int pipe_end, unsigned seed) {
  LogWriter writer(path);
  Recorder run(writer, kWidth, {}, LogPolicy::lossless, seed);
  Acknowledged done;
  for (std::int64_t k = 0;; k += 150) {
    run.write(k, k + 149);
    run.frames.clear();
    Command command;
    command.k = k;
    command.body = Json{{"end_attack", "a" + std::to_string(done.commands)}};
    writer.command(run.id, command);
    ++done.commands;
    if (k % 450 == 0) {
      writer.flush();
      done.flushed = k + 149;
    }
    if (::write(pipe_end, &done, sizeof done) != sizeof done) _exit(1);
  }
}

Acknowledged kill_after(const std::string& path, int acknowledgements, unsigned seed) {
  int ends[2];
  EXPECT_EQ(0, pipe(ends));
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    try {
      write_until_killed(path, ends[1], seed);
    } catch (...) {
      _exit(3);
    }
  }
  close(ends[1]);
  Acknowledged last, one;
  for (int i = 0; i < acknowledgements && ::read(ends[0], &one, sizeof one) == sizeof one; ++i) last = one;
  kill(child, SIGKILL);
  while (::read(ends[0], &one, sizeof one) == sizeof one) last = one;
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status));
  return last;
}

TEST(Kill, NothingAcknowledgedIsLostAndTheFileIsSound) {
  std::mt19937 random(11);
  for (unsigned round = 0; round < 10; ++round) {
    SCOPED_TRACE(round);
    const Folder folder;
    const std::string path = folder.file("a.db");
    const auto acknowledged = kill_after(path, static_cast<int>(1 + random() % 25), round);
    ASSERT_GT(acknowledged.commands, 0);

    LogWriter writer(path);
    LogReader reader(path);
    const auto row = reader.run(1);
    ASSERT_TRUE(row);
    EXPECT_EQ("interrupted", row->state);
    EXPECT_TRUE(row->ended);
    ASSERT_GE(static_cast<std::int64_t>(row->commands.size()), acknowledged.commands);
    for (std::size_t i = 0; i < row->commands.size(); ++i) {
      EXPECT_EQ("a" + std::to_string(i), row->commands[i].body.at("end_attack").get<std::string>());
    }
    const auto frames = test::read_all(reader, 1, test::ids(kWidth));
    EXPECT_GE(static_cast<std::int64_t>(frames.size()), acknowledged.flushed + 1);
    EXPECT_EQ(row->k, frames.empty() ? -1 : frames.back().k);
    // The same seed draws the same frames: what survived is an exact beginning of what was written.
    LogWriter twin(folder.file("twin.db"));
    Recorder again(twin, kWidth, {}, LogPolicy::lossless, round);
    if (!frames.empty()) again.write(0, frames.back().k);
    test::expect_same(again.frames, frames);
    const auto report = check_log(path);
    EXPECT_TRUE(report.ok) << test::all_of(report);
  }
}

}  // namespace
}  // namespace vigil::kill_test
