/// The file itself: opening, refusing, migrating, backing up, pruning, checking.
#include <sqlite3.h>
#include <unistd.h>

#include <fstream>

#include "tests/db/helpers.hpp"

namespace vigil::file_test {
namespace {

using test::Folder;
using test::Recorder;

/// SQL against a file, past all of our own code.
void raw_sql(const std::string& path, const std::string& sql) {
  sqlite3* connection = nullptr;
  ASSERT_EQ(SQLITE_OK, sqlite3_open(path.c_str(), &connection));
  char* error = nullptr;
  EXPECT_EQ(SQLITE_OK, sqlite3_exec(connection, sql.c_str(), nullptr, nullptr, &error)) << (error ? error : "");
  sqlite3_free(error);
  sqlite3_close(connection);
}

std::string refusal(const std::function<void()>& attempt) {
  try {
    attempt();
  } catch (const LogError& error) {
    EXPECT_EQ(LogError::Kind::unusable, error.kind());
    return error.what();
  }
  return "";
}

std::string contents(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(in), {});
}

TEST(File, AnEmptyFileBecomesALogAndOpensAgain) {
  const Folder folder;
  const std::string path = folder.file("a.db");
  std::ofstream(path).close();
  { LogWriter writer(path); }
  { LogWriter writer(path); }
  EXPECT_TRUE(check_log(path).ok);
  EXPECT_EQ(0, LogReader(path).counts().runs);
}

TEST(File, WhatIsNotOursIsRefusedAndLeftAlone) {
  const Folder folder;
  const std::string text = folder.file("text.db"), other = folder.file("other.db"), newer = folder.file("newer.db");
  std::ofstream(text) << std::string(5000, 'x');
  raw_sql(other, "CREATE TABLE t(a); INSERT INTO t VALUES(1)");
  { LogWriter writer(newer); }
  raw_sql(newer, "PRAGMA user_version=99");
  for (const auto& [path, words] : {std::pair(text, "is not a database"), std::pair(other, "of another program"),
                                    std::pair(newer, "newer Vigil (schema 99")}) {
    const std::string before = contents(path);
    EXPECT_NE(std::string::npos, refusal([&] { LogWriter writer(path); }).find(words)) << path;
    EXPECT_NE(std::string::npos, refusal([&] { LogReader reader(path); }).find(words)) << path;
    EXPECT_EQ(before, contents(path));
  }
  EXPECT_NE("", refusal([&] { LogWriter writer(folder.path()); }));
  EXPECT_NE("", refusal([&] { LogWriter writer(folder.file("no/such/folder/a.db")); }));
  EXPECT_NE("", refusal([&] { LogReader reader(folder.file("missing.db")); }));
}

TEST(File, AnUnwritableFileIsRefused) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  const Folder folder;
  const std::string path = folder.file("a.db");
  { LogWriter writer(path); }
  std::filesystem::permissions(path, std::filesystem::perms::owner_read);
  EXPECT_NE(std::string::npos, refusal([&] { LogWriter writer(path); }).find("not writable"));
}

TEST(File, TwoWritersAreRefused) {
  const Folder folder;
  const std::string path = folder.file("a.db");
  {
    LogWriter first(path);
    const std::string sentence = refusal([&] { LogWriter second(path); });
    EXPECT_NE(std::string::npos, sentence.find("in use by another vigil (process " + std::to_string(getpid()) + ")"));
    EXPECT_NE("", refusal([&] { vacuum_log(path); }));
    EXPECT_NE("", refusal([&] { prune_log(path, 1); }));
    EXPECT_TRUE(check_log(path).ok);
  }
  LogWriter third(path);
}

TEST(File, OpenRunsOfAnEndedServerAreInterrupted) {
  const Folder folder;
  const std::string path = folder.file("a.db");
  RunId queued = 0, running = 0, finished = 0;
  {
    LogWriter writer(path);
    queued = writer.create_run(test::record()).id;
    Recorder open(writer, 2), closed(writer, 2);
    open.write(0, 99);
    closed.finish();
    running = open.id;
    finished = closed.id;
  }
  LogOptions options;
  options.clock = [] { return WallTime{77}; };
  LogWriter writer(path, options);
  const LogReader reader(path);
  EXPECT_EQ("interrupted", reader.run(queued)->state);
  EXPECT_EQ("interrupted", reader.run(running)->state);
  EXPECT_EQ(77, reader.run(running)->ended);
  EXPECT_EQ(99, reader.run(running)->k);
  EXPECT_EQ("finished", reader.run(finished)->state);
  const auto marks = reader.marks(running, {}).items;
  ASSERT_EQ(1u, marks.size());
  EXPECT_EQ("interrupted", marks[0].mark.code);
  EXPECT_EQ(99, marks[0].mark.k);
  EXPECT_TRUE(check_log(path).ok);
}

TEST(File, AnOlderSchemaIsBroughtUpToDateWithItsRuns) {
  const Folder folder;
  const std::string path = folder.file("a.db");
  RunId run = 0;
  {
    LogWriter writer(path);
    Recorder recorder(writer, 3);
    recorder.write(0, 99);
    recorder.finish();
    run = recorder.id;
  }
  raw_sql(path,
          "DROP TABLE design; ALTER TABLE document DROP COLUMN designs; DROP TABLE campaign_cell; "
          "DROP TABLE campaign_summary; "
          "DROP INDEX campaign_by_key; DROP INDEX campaign_trial_lost; ALTER TABLE campaign DROP COLUMN key; ALTER "
          "TABLE campaign DROP COLUMN hash; "
          "ALTER TABLE campaign_trial DROP COLUMN numbers; ALTER TABLE campaign_trial DROP COLUMN ticks; "
          "ALTER TABLE campaign_trial DROP COLUMN faults; ALTER TABLE campaign_trial DROP COLUMN warnings; "
          "ALTER TABLE campaign_trial DROP COLUMN error; ALTER TABLE campaign_trial DROP COLUMN run; "
          "INSERT INTO campaign(state,request,trials,created) VALUES('interrupted','{}',3,1),('finished','{}',1,1); "
          "INSERT INTO campaign_trial(campaign,position,seed,state,metrics) VALUES(2,0,9,'finished','[1]'); "
          "PRAGMA user_version=1");
  EXPECT_NE(std::string::npos, refusal([&] { LogReader reader(path); }).find("older schema"));
  LogWriter writer(path);
  const LogReader reader(path);
  EXPECT_EQ("finished", reader.run(run)->state);
  EXPECT_TRUE(reader.run(run)->designs.is_null());
  writer.put_design("0123456789abcdef", "a", {{"holds", true}}, "a problem");
  EXPECT_TRUE(reader.design("0123456789abcdef"));
  EXPECT_EQ("cancelled", reader.campaign(1)->state) << "it kept too little to be gone on with";
  EXPECT_EQ("finished", reader.campaign(2)->state);
  EXPECT_EQ(Json::parse("[1]"), reader.trials(2).at(0).metrics);
  EXPECT_TRUE(check_log(path).ok);
}

TEST(File, CampaignsOfAnEndedServerAreInterruptedAndPausedOnesStayPaused) {
  const Folder folder;
  const std::string path = folder.file("a.db");
  {
    LogWriter writer(path);
    for (const char* state : {"queued", "running", "paused", "finished", "cancelled"})
      writer.update_campaign(writer.create_campaign({}).id, state);
  }
  LogWriter writer(path);
  std::vector<std::string> states;
  for (const CampaignRow& row : LogReader(path).campaigns()) states.push_back(row.state);
  EXPECT_EQ(states, (std::vector<std::string>{"cancelled", "finished", "paused", "interrupted", "interrupted"}));
}

TEST(File, ABackupOfABusyLogOpensAndChecks) {
  const Folder folder;
  LogWriter writer(folder.file("a.db"));
  Recorder run(writer, 5);
  run.write(0, 2999);
  writer.flush();
  std::atomic<bool> stop{false};
  std::thread busy([&] {
    for (std::int64_t k = 3000; !stop; k += 100) {
      run.write(k, k + 99);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  });
  const auto report = backup_log(folder.file("a.db"), folder.file("copy.db"));
  stop = true;
  busy.join();
  EXPECT_TRUE(report.ok) << test::all_of(report);
  EXPECT_EQ(1, report.runs);
  EXPECT_THROW(backup_log(folder.file("a.db"), folder.file("copy.db")), LogError);
  EXPECT_THROW(backup_log(folder.file("none.db"), folder.file("copy2.db")), LogError);
  EXPECT_THROW(backup_log(folder.file("a.db"), folder.file("no/folder/copy.db")), LogError);
  LogWriter copy(folder.file("copy.db"));
  const LogReader reader(folder.file("copy.db"));
  const auto frames = test::read_all(reader, run.id, test::ids(5));
  ASSERT_GE(frames.size(), 3000u);
  run.frames.resize(frames.size());
  test::expect_same(run.frames, frames);
  EXPECT_EQ("interrupted", reader.run(run.id)->state);
}

TEST(File, CheckFindsEveryKindOfDamage) {
  const Folder folder;
  const std::string good = folder.file("good.db");
  {
    LogWriter writer(good);
    Recorder run(writer, 3);
    run.write(0, 1999);
    writer.flush();
  }
  ASSERT_TRUE(check_log(good).ok);
  const std::vector<std::pair<std::string, std::string>> damages = {
      {"UPDATE chunk SET data=substr(data,1,length(data)-1)||x'55' WHERE block=1 AND sig=2", "CRC"},
      {"UPDATE chunk SET data=x'00' WHERE block=0 AND sig=0", "too short"},
      {"DELETE FROM chunk WHERE block=1 AND sig=1", "2 chunks for 3 signals"},
      {"DELETE FROM block WHERE block=1", "missing and no gap says so"},
      {"UPDATE rollup SET hi=hi+1 WHERE level=0 AND b=2 AND sig=1", "does not agree"},
      {"DELETE FROM rollup WHERE level=0 AND b=0 AND sig=0", "does not agree"},
      {"UPDATE block SET n=600 WHERE block=0", "impossible bounds"},
      {"INSERT INTO tail(run,k,v) VALUES(1,3000,zeroblob(32))", "missing and no gap says so"},
      {"INSERT INTO tail(run,k,v) VALUES(1,2000,x'00')", "wrong size"},
      {"INSERT INTO tail(run,k,v) VALUES(9,1,zeroblob(32))", "run 9, which is not there"},
      {"INSERT INTO mark(run,k,type,edge,ref,lane,node,link,code,detail) VALUES(5,1,'note','','','','','','','')",
       "table mark"}};
  for (const auto& [sql, words] : damages) {
    const std::string bad = folder.file("bad.db");
    std::filesystem::copy_file(good, bad, std::filesystem::copy_options::overwrite_existing);
    raw_sql(bad, sql);
    const auto report = check_log(bad);
    EXPECT_FALSE(report.ok) << sql;
    EXPECT_NE(std::string::npos, test::all_of(report).find(words)) << sql << "\n" << test::all_of(report);
  }
}

TEST(File, RubbishInThePagesNeverCrashesTheCheck) {
  const Folder folder;
  const std::string good = folder.file("good.db"), bad = folder.file("bad.db");
  {
    LogWriter writer(good);
    Recorder run(writer, 6);
    run.write(0, 2999);
  }
  const std::string bytes = contents(good);
  std::mt19937 random(9);
  int found = 0;
  for (int round = 0; round < 40; ++round) {
    std::string broken = bytes;
    for (int i = 0; i < 200; ++i) broken[4096 + random() % (broken.size() - 4096)] = static_cast<char>(random());
    std::ofstream(bad, std::ios::binary) << broken;
    try {
      found += check_log(bad).ok ? 0 : 1;
    } catch (const LogError&) {
      ++found;
    }
  }
  EXPECT_EQ(40, found);
}

TEST(File, PruneAndVacuumGiveSpaceBack) {
  const Folder folder;
  const std::string path = folder.file("a.db");
  constexpr WallTime kDay = 86400LL * 1'000'000'000;
  RunId old_run = 0, kept = 0, fresh = 0;
  {
    LogOptions options;
    options.clock = [] { return 100 * kDay; };
    LogWriter writer(path, options);
    for (RunId* id : {&old_run, &kept, &fresh}) {
      Recorder run(writer, 10);
      run.write(0, 9999);
      RunUpdate end;
      end.state = "finished";
      end.ended = (id == &fresh ? 99 : 60) * kDay;
      if (id == &kept) end.tags = {"keep"};
      writer.finish(run.id, end);
      *id = run.id;
    }
  }
  const auto report = prune_log(path, 30, [] { return 100 * kDay; });
  EXPECT_EQ(1, report.runs);
  EXPECT_LT(report.bytes_after, report.bytes_before * 3 / 4);
  const LogReader reader(path);
  EXPECT_FALSE(reader.run(old_run));
  EXPECT_TRUE(reader.run(kept));
  EXPECT_TRUE(reader.run(fresh));
  EXPECT_TRUE(check_log(path).ok);
  raw_sql(path, "DELETE FROM rollup");
  const auto vacuumed = vacuum_log(path);
  EXPECT_LE(vacuumed.bytes_after, report.bytes_after);
  EXPECT_TRUE(reader.run(fresh));
}

}  // namespace
}  // namespace vigil::file_test
