/// The language of q: what each form finds, what is refused and where, and that nothing of it ever is SQL.
#include "db/query.hpp"

#include <algorithm>
#include <set>

#include "tests/db/helpers.hpp"

namespace vigil::query_test {
namespace {

constexpr WallTime kHour = 3600LL * 1'000'000'000;
const WallTime kNow = 1'772'366'400LL * 1'000'000'000;  // 2026-03-01T12:00:00Z

MetricValue metric(const std::string& lane, const std::string& name, double value, const std::string& node = "",
                   const std::string& variant = "") {
  return {lane, node, name, variant, value, false};
}

/// Runs 1, 2, … with known fields.
class Queries : public testing::Test {
 protected:
  void SetUp() override {
    LogOptions options;
    options.clock = [this] { return clock_.load(); };
    writer_ = std::make_unique<LogWriter>(folder_.file("a.db"), options);
    reader_ = std::make_unique<LogReader>(folder_.file("a.db"));
    add("consensus", 1, 0.02, {"paper", "keep"}, "First light", kNow - 50 * kHour, "finished",
        {metric("consensus", "rmse_position", 2.6), metric("drop", "rmse_position", 3.5),
         metric("consensus", "rmse_position", 9.0, "1")});
    add("consensus-compass", 2, 0.05, {}, "it's 100% \"done\"", kNow - 30 * kHour, "failed",
        {metric("consensus", "rmse_position", 1.5), metric("consensus", "bound_guaranteed", 0)});
    add("mrclam", 18446744073709551615ull, 0.02, {"robot"}, "", kNow - kHour, "finished",
        {metric("centralized", "rmse_position", 0.37), metric("consensus", "mse", 4, "", "fusing")});
    add("consensus", 7, 0.5, {"paper"}, "naïve 机器人", kNow - kHour / 2, "running", {});
  }

  void add(const std::string& scenario, std::uint64_t seed, double tau, std::vector<std::string> tags,
           const std::string& note, WallTime created, const std::string& state,
           const std::vector<MetricValue>& metrics) {
    clock_ = created;
    RunRecord record = test::record(scenario);
    record.seed = seed;
    record.tags = std::move(tags);
    record.note = note;
    record.document["lanes"]["consensus"]["params"]["tau"] = tau;
    record.document["network"]["graph"] = scenario == "mrclam" ? "nearest" : "ladder";
    record.document["adversary"]["links"]["enabled"] = seed == 7;
    const RunId id = writer_->create_run(record).id;
    RunUpdate update;
    update.state = state;
    update.metrics = metrics;
    if (state != "running") update.ended = created + kHour;
    writer_->update(id, update);
  }

  std::set<RunId> find(const std::string& text) {
    std::set<RunId> ids;
    const Query query = Query::parse(text, kNow);
    for (const auto& row : reader_->list(query, "", 100, "").items) ids.insert(row.id);
    EXPECT_EQ(static_cast<std::int64_t>(ids.size()), reader_->count(query)) << text;
    return ids;
  }

  test::Folder folder_;
  std::atomic<WallTime> clock_{0};
  std::unique_ptr<LogWriter> writer_;
  std::unique_ptr<LogReader> reader_;
};

TEST_F(Queries, EveryFormFindsWhatItSays) {
  using Ids = std::set<RunId>;
  const std::vector<std::pair<std::string, Ids>> table = {
      {"", {1, 2, 3, 4}},
      {"   ", {1, 2, 3, 4}},
      {"scenario:consensus", {1, 4}},
      {"scenario:CONSENSUS", {1, 4}},
      {"scenario~consensus", {1, 2, 4}},
      {"scenario!=consensus", {2, 3}},
      {"scenario:\"mrclam\"", {3}},
      {"id:3", {3}},
      {"id:2..3", {2, 3}},
      {"id>2", {3, 4}},
      {"id>=2 id<4", {2, 3}},
      {"seed:7", {4}},
      {"parent:null", {1, 2, 3, 4}},
      {"parent:1", {}},
      {"seed:18446744073709551615", {3}},
      {"seed:2..", {2, 4}},
      {"seed:0..2", {1, 2}},
      {"state:running", {4}},
      {"state:finished AND scenario:consensus", {1}},
      {"state:finished scenario:consensus", {1}},
      {"state:failed OR state:running", {2, 4}},
      {"state:failed OR state:running AND scenario:mrclam", {2}},
      {"(state:failed OR state:running) AND scenario:consensus", {4}},
      {"NOT state:finished", {2, 4}},
      {"NOT (state:finished OR state:failed)", {4}},
      {"NOT NOT state:failed", {2}},
      {"((((state:failed))))", {2}},
      {"tag:paper", {1, 4}},
      {"tags:paper tag:keep", {1}},
      {"tag!=paper", {2, 3}},
      {"tag~obo", {3}},
      {"tag:null", {2}},
      {"note:light", {1}},
      {"note=\"First light\"", {1}},
      {"note~FIRST", {1}},
      {"note:\"it's 100% \\\"done\\\"\"", {2}},
      {"note:机器人", {4}},
      {"note:null", {3}},
      {"light", {1}},
      {"PAPER", {1, 4}},
      {"\"naïve\"", {4}},
      {"robot", {3}},
      {"family:consensus", {1, 2, 3, 4}},
      {"created>-2h", {3, 4}},
      {"created:-2h", {3, 4}},
      {"created<-1d", {1, 2}},
      {"created:-40h..-45m", {2, 3}},
      {"created:2026-03-01", {3, 4}},
      {"created!=2026-03-01", {1, 2}},
      {"created:2026-02-27", {1}},
      {"created:2026-02-27..2026-02-28", {1, 2}},
      {"created>=2026-03-01T11:30", {4}},
      {"created:2026-03-01T11", {3, 4}},
      {"created:2026-03-01T11:00:00Z", {3}},
      {"created:2026-03-01T11:00:00.000Z", {3}},
      {"created<=2026-02-28", {1, 2}},
      {"created>2026-02-28", {3, 4}},
      {"ended:null", {4}},
      {"ended>-2h", {3}},
      {"started:null", {1, 2, 3, 4}},
      {"metrics.rmse_position<1", {3}},
      {"metrics.rmse_position:2..3", {1}},
      {"metrics.rmse_position>5", {}},
      {"consensus.rmse_position<2", {2}},
      {"consensus.rmse_position:..3", {1, 2}},
      {"drop.rmse_position>3", {1}},
      {"consensus.rmse_position:null", {3, 4}},
      {"consensus.bound_guaranteed:false", {2}},
      {"consensus.mse.fusing:4", {3}},
      {"consensus.mse.other:4", {}},
      {"params.lanes.consensus.params.tau:0.02", {1, 3}},
      {"params.lanes.consensus.params.tau>=0.05", {2, 4}},
      {"params.network.graph:nearest", {3}},
      {"params.network.graph~LAD", {1, 2, 4}},
      {"params.adversary.links.enabled:true", {4}},
      {"params.no.such.thing:1", {}},
      {"params.no.such.thing:null", {1, 2, 3, 4}},
      {"NOT params.no.such.thing:1", {1, 2, 3, 4}},
      {"NOT ended>-2h", {1, 2, 4}}};
  for (const auto& [text, ids] : table) EXPECT_EQ(ids, find(text)) << text;
}

TEST_F(Queries, WhatCannotBeReadIsRefusedAtItsColumn) {
  const std::vector<std::pair<std::string, int>> table = {{"state:", 7},
                                                          {"colour:red", 1},
                                                          {"state:failed AND", 17},
                                                          {"state:failed OR", 16},
                                                          {"AND state:failed", 1},
                                                          {"OR", 1},
                                                          {"NOT", 4},
                                                          {"(state:failed", 14},
                                                          {"state:failed)", 13},
                                                          {"()", 2},
                                                          {"seed:abc", 6},
                                                          {"seed:1.5", 6},
                                                          {"seed:1..x", 9},
                                                          {"seed:..", 6},
                                                          {"seed~1", 6},
                                                          {"created:yesterday", 9},
                                                          {"created:2026-02-30", 9},
                                                          {"created:2026-13-01", 9},
                                                          {"created:2026-03-01T25", 9},
                                                          {"created:2026", 9},
                                                          {"created:-2y", 9},
                                                          {"created:--2h", 9},
                                                          {"created:-1e300h", 9},
                                                          {"created~2026", 9},
                                                          {"tag>a", 5},
                                                          {"metrics.rmse<abc", 14},
                                                          {"metrics.rmse<nan", 14},
                                                          {"metrics.rmse:inf", 14},
                                                          {"metrics.:1", 1},
                                                          {".rmse:1", 1},
                                                          {"params.:1", 1},
                                                          {"params.a..b:1", 1},
                                                          {"run.id;DROP:1", 1},
                                                          {"col*r:red", 1},
                                                          {"note:\"open", 6},
                                                          {"机器人 AND colour:1", 9},
                                                          {std::string(33, '(') + "state:failed", 34},
                                                          {"state:failed \"", 14}};
  for (const auto& [text, column] : table) {
    try {
      Query::parse(text, kNow);
      ADD_FAILURE() << "accepted: " << text;
    } catch (const QueryError& error) {
      EXPECT_EQ(column, error.column()) << text << "\n" << error.what();
      EXPECT_GT(std::string(error.what()).size(), 20u);
    }
  }
  std::string many = "a", nots;
  for (int i = 0; i < 64; ++i) many += " a";
  for (int i = 0; i < 60; ++i) nots += "NOT ";
  EXPECT_THROW(Query::parse(many, kNow), QueryError);
  EXPECT_THROW(Query::parse(nots + "a", kNow), QueryError);
  EXPECT_THROW(Query::parse(std::string(2001, 'a'), kNow), QueryError);
  EXPECT_NO_THROW(Query::parse(std::string(2000, 'a'), kNow));
}

TEST_F(Queries, NothingTheUserWroteIsSql) {
  const std::vector<std::string> hostile = {
      "'; DROP TABLE run; --", "x' OR '1'='1", "\\\"; DELETE FROM run; --", "') OR 1=1 --", "?1", "$", "%", "_", "*",
      std::string("a\0b", 3),  "\xff\xfe"};
  for (const auto& text : hostile) {
    for (const std::string field : {"note:", "scenario:", "state=", "tag:", "note~", "params.network.graph:", ""}) {
      const Query query = Query::parse(field + "\"" + text + "\"", kNow);
      EXPECT_EQ(std::string::npos, query.sql().find("DROP"));
      EXPECT_EQ(std::string::npos, query.sql().find("DELETE"));
      EXPECT_EQ(std::string::npos, query.sql().find("1=1"));
      reader_->count(query);
    }
  }
  EXPECT_EQ((std::set<RunId>{2}), find("note:\"%\""));
  EXPECT_EQ((std::set<RunId>{1, 2, 3, 4}), find(""));
}

TEST_F(Queries, RandomTextsAreReadOrRefusedNeverWorse) {
  std::mt19937 random(2);
  const std::vector<std::string> pieces = {"(",          ")",    "AND",       "OR",   "NOT", " ",  ":",   "..", "\"",
                                           "state",      "seed", "metrics.x", ">",    "<=",  "~",  "-2h", "1",  "null",
                                           "params.a.b", "\\",   "机",        "\xc3", "'",   "!=", "."};
  int read = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string text;
    for (std::size_t n = random() % 12; n > 0; --n) text += pieces[random() % pieces.size()];
    try {
      reader_->count(Query::parse(text, kNow));
      ++read;
    } catch (const QueryError&) {
    }
  }
  EXPECT_GT(read, 100);
  EXPECT_LT(read, 2900);
}

TEST_F(Queries, PagesInEveryOrderGiveEachRunOnce) {
  for (int i = 0; i < 23; ++i) {
    std::vector<MetricValue> metrics;
    if (i % 3 != 0) metrics.push_back(metric("consensus", "rmse_position", i % 4));
    add(i % 2 == 0 ? "alpha" : "beta", static_cast<std::uint64_t>(i % 5), 0.1, {}, "", kNow + i % 7, "finished",
        metrics);
  }
  for (const std::string field : {"id", "created", "started", "ended", "scenario", "state", "seed",
                                  "metrics.rmse_position", "consensus.rmse_position", "drop.rmse_position"}) {
    for (const std::string way : {"", "-"}) {
      const std::string sort = way + field;
      std::vector<RunId> whole, paged;
      for (const auto& row : reader_->list({}, sort, 1000, "").items) whole.push_back(row.id);
      ASSERT_EQ(27u, whole.size());
      std::string cursor;
      for (int page = 0; page < 20; ++page) {
        const auto piece = reader_->list({}, sort, 4, cursor);
        for (const auto& row : piece.items) paged.push_back(row.id);
        if (!piece.next) break;
        cursor = *piece.next;
      }
      EXPECT_EQ(whole, paged) << sort;
    }
  }
  const auto first = reader_->list({}, "created", 2, "");
  EXPECT_THROW(reader_->list({}, "-created", 2, *first.next), QueryError);
  EXPECT_THROW(reader_->list({}, "", 2, "zz"), QueryError);
  EXPECT_THROW(reader_->list({}, "", 2, "5b5d"), QueryError);
  EXPECT_THROW(reader_->list({}, "colour", 2, ""), QueryError);
  EXPECT_THROW(reader_->list({}, "-", 2, ""), QueryError);
  EXPECT_THROW(reader_->list({}, "", 0, ""), QueryError);
  EXPECT_THROW(reader_->list({}, "", 1001, ""), QueryError);
  EXPECT_EQ(27, reader_->list({}, "", 1, "").items[0].id);
}

}  // namespace
}  // namespace vigil::query_test
