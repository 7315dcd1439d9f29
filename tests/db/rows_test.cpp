/// Runs, commands, marks, scenarios, traces: in and out again; idempotency keys.
#include "tests/db/helpers.hpp"

namespace vigil::rows_test {
namespace {

using test::kDay;
using test::kSecond;
using test::Recorder;

class Rows : public test::ClockedLog {};

TEST_F(Rows, ARunKeepsEveryField) {
  RunRecord record = test::record();
  record.seed = 0xfedcba9876543210ull;
  record.cpu = "avx2";
  record.pace = 20.5;
  record.input = Json{{"trace", 3}};
  record.trace = 3;
  record.tags = {"a", "机"};
  record.note = "bad \xff utf-8";
  record.parent = RunParent{5, 412};
  record.steps = 30;
  record.policy = LogPolicy::live;
  record.keep = 600.5;
  record.reproducible = false;
  const RunId id = writer.create_run(record).id;
  RunUpdate update;
  update.state = "failed";
  update.started = 5;
  update.ended = 6;
  update.error = "It broke.";
  update.metrics = {{"consensus", "", "rmse_position", "", 2.6, false},
                    {"consensus", "1", "rmse_position", "", NAN, false},
                    {"consensus", "", "theorem2_holds", "", 1, true}};
  update.faults = {{"consensus", "1", "infeasible_28", 2, 30, 29, true, "detail"}};
  update.design = Json{{"consensus", {{"gain", 0.1 + 0.2}, {"none", NAN}}}};
  update.world = Json{{"nodes", Json::array()}};
  update.warnings = {"w1", "w2"};
  writer.update(id, update);
  writer.command(id, {7, Json{{"end_attack", "a1"}}});
  writer.command(id, {7, Json{{"params", {{"lanes.consensus.params.tau", 0.1}}}}});
  const auto row = *reader.run(id);
  EXPECT_EQ(record.seed, row.seed);
  EXPECT_EQ("avx2", row.cpu);
  EXPECT_EQ(20.5, row.pace);
  EXPECT_EQ(record.input, row.input);
  EXPECT_EQ(3, row.trace);
  EXPECT_EQ(record.tags, row.tags);
  EXPECT_EQ(412, row.parent->k);
  EXPECT_EQ(30, row.steps);
  EXPECT_EQ(LogPolicy::live, row.policy);
  EXPECT_EQ(600.5, row.keep);
  EXPECT_FALSE(row.reproducible);
  EXPECT_EQ("failed", row.state);
  EXPECT_EQ(5, row.started);
  EXPECT_EQ(6, row.ended);
  EXPECT_EQ("It broke.", row.error);
  EXPECT_EQ("Eight cameras", row.title["en"]);
  EXPECT_EQ(record.document, row.document);
  EXPECT_EQ(record.document_hash, row.document_hash);
  ASSERT_EQ(3u, row.metrics.size());
  EXPECT_EQ(2.6, row.metrics[0].value);
  EXPECT_TRUE(std::isnan(row.metrics[1].value));
  EXPECT_TRUE(row.metrics[2].boolean);
  ASSERT_EQ(1u, row.faults.size());
  EXPECT_EQ(29, row.faults[0].count);
  EXPECT_TRUE(row.faults[0].stopped);
  EXPECT_EQ(0.1 + 0.2, row.design["consensus"]["gain"]);
  EXPECT_TRUE(row.design["consensus"]["none"].is_null());
  EXPECT_EQ((std::vector<std::string>{"w1", "w2"}), row.warnings);
  ASSERT_EQ(2u, row.commands.size());
  EXPECT_EQ(7, row.commands[1].k);
  const auto item = reader.list({}, "", 10, "").items.at(0);
  EXPECT_EQ(2u, item.metrics.size());
  EXPECT_TRUE(item.document.is_null());
  EXPECT_EQ("2026-03-01T12:00:00.250Z", to_rfc3339(1'772'366'400LL * kSecond + 250'000'000));
  EXPECT_EQ("1969-12-31T23:59:59.999Z", to_rfc3339(-1));
}

TEST_F(Rows, WhatIsMissingIsSaid) {
  for (const auto& attempt : std::vector<std::function<void()>>{
           [&] { writer.update(5, {}); }, [&] { writer.delete_run(5); }, [&] { writer.command(5, {}); },
           [&] { writer.finish(5, {}); }, [&] { writer.update_campaign(5, "finished"); }}) {
    try {
      attempt();
      ADD_FAILURE();
    } catch (const LogError& error) {
      EXPECT_EQ(LogError::Kind::missing, error.kind());
    }
  }
  RunUpdate bad;
  bad.state = "no such state";
  const RunId id = writer.create_run(test::record()).id;
  EXPECT_ANY_THROW(writer.update(id, bad));
  EXPECT_EQ("queued", reader.run(id)->state);
  EXPECT_EQ(LogHealth::State::ok, writer.health().state);
}

TEST_F(Rows, AnIdempotencyKeyMakesOneRunFor24Hours) {
  RunRecord record = test::record();
  record.idempotency_key = "k1";
  record.idempotency_hash = "h1";
  const auto first = writer.create_run(record);
  EXPECT_TRUE(first.fresh);
  clock += kDay - kSecond;
  const auto again = writer.create_run(record);
  EXPECT_FALSE(again.fresh);
  EXPECT_EQ(first.id, again.id);
  record.idempotency_hash = "h2";
  try {
    writer.create_run(record);
    ADD_FAILURE();
  } catch (const LogError& error) {
    EXPECT_EQ(LogError::Kind::conflict, error.kind());
  }
  clock += 2 * kSecond;
  EXPECT_TRUE(writer.create_run(record).fresh);
  record.idempotency_key = "k2";
  const auto second = writer.create_run(record);
  writer.delete_run(second.id);
  EXPECT_TRUE(writer.create_run(record).fresh);
  EXPECT_EQ(3, reader.counts().runs);
}

TEST_F(Rows, MarksPageInOrderAndFilter) {
  const RunId id = writer.create_run(test::record()).id;
  for (int i = 0; i < 200; ++i) {
    Mark mark;
    mark.k = i / 3 * 2;
    mark.type = i % 2 == 0 ? MarkType::attack : MarkType::fault;
    mark.edge = i % 4 == 0 ? MarkEdge::begin : MarkEdge::end;
    mark.lane = i % 5 == 0 ? "drop" : "consensus";
    mark.code = std::to_string(i);
    writer.mark(id, mark);
  }
  writer.flush();
  MarkFilter filter;
  filter.limit = 7;
  std::vector<std::string> codes;
  for (;;) {
    const auto page = reader.marks(id, filter);
    for (const auto& item : page.items) codes.push_back(item.mark.code);
    if (!page.next) break;
    filter.cursor = *page.next;
  }
  ASSERT_EQ(200u, codes.size());
  for (int i = 0; i < 200; ++i) EXPECT_EQ(std::to_string(i), codes[static_cast<std::size_t>(i)]);
  filter = {};
  filter.types = {MarkType::attack};
  filter.lanes = {"drop"};
  filter.from = 10;
  filter.to = 60;
  for (const auto& item : reader.marks(id, filter).items) {
    EXPECT_EQ(MarkType::attack, item.mark.type);
    EXPECT_EQ("drop", item.mark.lane);
    EXPECT_TRUE(item.mark.k >= 10 && item.mark.k <= 60);
  }
  EXPECT_EQ(8u, reader.marks(id, filter).items.size());
  filter.cursor = "nonsense";
  EXPECT_THROW(reader.marks(id, filter), QueryError);
}

TEST_F(Rows, ScenariosTracesSettings) {
  writer.put_scenario("mine", Json{{"vigil", 1}});
  clock += kSecond;
  writer.put_scenario("mine", Json{{"vigil", 2}});
  ASSERT_TRUE(reader.scenario("mine"));
  EXPECT_EQ(2, reader.scenario("mine")->document["vigil"]);
  EXPECT_EQ(kSecond, reader.scenario("mine")->updated - reader.scenario("mine")->created);
  EXPECT_TRUE(writer.delete_scenario("mine"));
  EXPECT_FALSE(writer.delete_scenario("mine"));
  EXPECT_TRUE(reader.scenarios().empty());

  std::string csv = "k,t,truth.x\n0,0,1\n";
  csv += std::string(100000, '\n');
  const auto id = writer.put_trace("walk", csv, 1, {"truth.x"});
  EXPECT_EQ(id, writer.put_trace("again", csv, 1, {"truth.x"}));
  EXPECT_EQ(csv, reader.trace_csv(id));
  EXPECT_EQ(sha256_hex(csv), reader.trace(id)->hash);
  EXPECT_EQ((std::vector<std::string>{"truth.x"}), reader.traces().at(0).columns);
  EXPECT_TRUE(writer.delete_trace(id));
  EXPECT_FALSE(reader.trace(id));

  EXPECT_TRUE(reader.setting("a").is_null());
  writer.set_setting("a", Json{{"b", NAN}});
  EXPECT_TRUE(reader.setting("a")["b"].is_null());
}

TEST_F(Rows, ADeletedRunIsGoneAtOnceAndItsSamplesSoon) {
  Recorder gone(writer, 30), stays(writer, 3);
  gone.write(0, 3000);
  stays.write(0, 3000);
  writer.mark(gone.id, {});
  writer.delete_run(gone.id);
  EXPECT_FALSE(reader.run(gone.id));
  EXPECT_THROW(reader.samples(gone.id, {0}, 0, 10, 10), LogError);
  gone.write(3001, 4000);
  stays.finish();
  ASSERT_TRUE(test::eventually([&] { return reader.counts().blocks == 6; }));
  test::expect_same(stays.frames, test::read_all(reader, stays.id, test::ids(3)));
  const auto report = check_log(path());
  EXPECT_TRUE(report.ok) << test::all_of(report);
  EXPECT_EQ(1, report.runs);
}

}  // namespace
}  // namespace vigil::rows_test
