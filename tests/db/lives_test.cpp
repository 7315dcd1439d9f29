/// How long samples and runs live: the run's own keep, and the file's limits by age and size.
#include "tests/db/helpers.hpp"

namespace vigil::lives_test {
namespace {

using test::kDay;
using test::kSecond;
using test::Recorder;

class Lives : public test::ClockedLog {};

TEST_F(Lives, KeepDropsSamplesThatAreOldAndNothingElse) {
  RunRecord record = test::record();
  record.keep = 10;
  Recorder source(writer, 4), other(writer, 4);
  const RunId id = writer.create_run(record).id;
  RunUpdate running;
  running.state = "running";
  writer.update(id, running);
  writer.set_signals(id, test::catalogue(4), {}, LogPolicy::live, 0.5);
  const auto write = [&](std::int64_t from, std::int64_t to) {
    for (std::int64_t k = from; k <= to; ++k) writer.frame(id, source.make(k));
    Mark mark;
    mark.k = from;
    mark.type = MarkType::alarm;
    writer.mark(id, mark);
    writer.flush();
  };
  other.write(0, 2999);
  write(0, 9999);
  writer.command(id, {3, Json{{"end_attack", "a"}}});
  clock += 6 * kSecond;
  write(10000, 12000);
  EXPECT_EQ(0, reader.samples(id, {0}, 0, 20000, 10).first);
  clock += 6 * kSecond;
  ASSERT_TRUE(test::eventually([&] { return reader.samples(id, {0}, 0, 20000, 10).first == 19 * 512; }));
  EXPECT_EQ(12000, reader.samples(id, {0}, 0, 20000, 10).last);
  MarkFilter filter;
  filter.types = {MarkType::alarm};
  EXPECT_EQ(1u, reader.marks(id, filter).items.size());
  EXPECT_EQ(1u, reader.commands(id).size());
  clock += 11 * kSecond;
  end(id, clock);
  clock += 11 * kSecond;
  ASSERT_TRUE(test::eventually([&] { return reader.samples(id, {0}, 0, 20000, 10).last == -1; }));
  EXPECT_EQ(3000u, test::read_all(reader, other.id, test::ids(4)).size());
  EXPECT_TRUE(reader.run(id));
  const auto report = check_log(path());
  EXPECT_TRUE(report.ok) << test::all_of(report);
}

TEST_F(Lives, RetentionByAgeSparesTaggedAndOpenRuns) {
  const RunId old_run = writer.create_run(test::record()).id, kept = writer.create_run(test::record()).id,
              fresh = writer.create_run(test::record()).id, open = writer.create_run(test::record()).id;
  end(old_run, clock - 40 * kDay);
  end(kept, clock - 40 * kDay, {"x", "keep"});
  end(fresh, clock - 20 * kDay);
  writer.set_retention(30.0, std::nullopt);
  ASSERT_TRUE(test::eventually([&] { return reader.counts().runs == 3; }));
  EXPECT_FALSE(reader.run(old_run));
  EXPECT_TRUE(reader.run(kept) && reader.run(fresh) && reader.run(open));
}

TEST_F(Lives, RetentionBySizeTakesOldestFirstAndTaggedLast) {
  std::vector<RunId> runs;
  for (int i = 0; i < 5; ++i) {
    Recorder run(writer, 20, {}, LogPolicy::lossless, static_cast<unsigned>(i));
    run.write(0, 8191);
    end(run.id, clock + (10 - i) * kSecond, i == 4 ? std::vector<std::string>{"keep"} : std::vector<std::string>{});
    runs.push_back(run.id);
  }
  Recorder open(writer, 20);
  open.write(0, 8191);
  writer.flush();
  // Six runs of about 1.2 MB: a limit of 3 MiB leaves the open one and one or two others.
  writer.set_retention(std::nullopt, 3.0 / 1024);
  ASSERT_TRUE(test::eventually([&] { return reader.counts().runs <= 3; }));
  EXPECT_TRUE(reader.run(open.id));
  EXPECT_TRUE(reader.run(runs[4]));
  EXPECT_FALSE(reader.run(runs[3]));
  EXPECT_FALSE(reader.run(runs[2]));
  writer.set_retention(std::nullopt, 1e-9);
  // Nothing that ended is left: the run that goes on gives up its oldest samples, and stays.
  ASSERT_TRUE(test::eventually([&] { return reader.counts().runs == 1 && reader.counts().blocks == 0; }));
  EXPECT_TRUE(reader.run(open.id));
  open.write(8192, 8300);
  open.finish();
  ASSERT_TRUE(test::eventually([&] { return reader.counts().runs == 0; }));
  EXPECT_TRUE(check_log(path()).ok);
}

}  // namespace
}  // namespace vigil::lives_test
