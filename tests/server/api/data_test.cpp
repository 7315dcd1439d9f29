#include "tests/server/api/fixture.hpp"

namespace vigil::api_test::data_test {
namespace {

class DataTest : public ApiTest {
 protected:
  void SetUp() override {
    ApiTest::SetUp();
    id_ = client_->start({{"scenario", "consensus"}, {"patch", {{"time", {{"steps", 200}}}}}});
    ASSERT_TRUE(client_->reaches(id_, "finished"));
    path_ = "/api/v1/runs/" + id_;
  }
  std::string id_, path_;
};

TEST_F(DataTest, SignalsSamplesAndTheirExtremesAgree) {
  const Json signals = client_->get(path_ + "/signals").json.at("items");
  ASSERT_GT(signals.size(), 10u);
  EXPECT_EQ(signals[0].at("id"), 0);
  const Json raw = client_->get(path_ + "/samples?signals=truth.x&points=5000").json;
  ASSERT_EQ(raw.at("k").size(), 201u);
  const Json& values = raw.at("series")[0].at("v");
  const Json coarse = client_->get(path_ + "/samples?signals=truth.x&points=10").json;
  const Json& buckets = coarse.at("k");
  ASSERT_GT(buckets.size(), 1u);
  for (std::size_t i = 0; i < buckets.size(); ++i) {
    const auto begin = buckets[i].get<std::size_t>();
    const std::size_t end = i + 1 < buckets.size() ? buckets[i + 1].get<std::size_t>() : values.size();
    double lo = values[begin], hi = values[begin];
    for (std::size_t k = begin; k < end; ++k) {
      lo = std::min(lo, values[k].get<double>());
      hi = std::max(hi, values[k].get<double>());
    }
    EXPECT_EQ(coarse.at("series")[0].at("lo")[i].get<double>(), lo);
    EXPECT_EQ(coarse.at("series")[0].at("hi")[i].get<double>(), hi);
  }
}

TEST_F(DataTest, SignalsArePickedByNamePatternAndId) {
  const Json named = client_->get(path_ + "/samples?signals=truth.y,truth.x,0&points=2000").json;
  ASSERT_EQ(named.at("series").size(), 2u);
  EXPECT_EQ(named.at("series")[0].at("signal"), "truth.y");
  const Json globbed = client_->get(path_ + "/samples?signals=lane.consensus.*.error&from=10&to=20").json;
  EXPECT_EQ(globbed.at("series").size(), 8u);
  EXPECT_EQ(globbed.at("k").size(), 11u);
  for (const char* query : {"signals=no.such", "signals=9999", "signals=truth.x,", "from=-1", "from=x", "to=1e9",
                            "points=1", "points=1000000"}) {
    SCOPED_TRACE(query);
    const bool trailing_comma = std::string(query) == "signals=truth.x,";
    const Answer answer = client_->get(path_ + "/samples?" + query);
    if (trailing_comma) {
      EXPECT_EQ(answer.status, 200);
    } else {
      expect_problem(answer, 400);
    }
  }
  EXPECT_TRUE(client_->get(path_ + "/samples?signals=truth.x&from=5000").json.at("k").empty());
}

TEST_F(DataTest, CsvHasEveryTickAtFullPrecision) {
  const Answer csv = client_->get(path_ + "/samples?signals=truth.x&from=3&to=5", {{"Accept", "text/csv"}});
  ASSERT_EQ(csv.status, 200);
  EXPECT_EQ(csv.header("Content-Type"), "text/csv; charset=utf-8");
  EXPECT_EQ(csv.body.substr(0, 12), "k,t,truth.x\n");
  const Json raw = client_->get(path_ + "/samples?signals=truth.x&from=3&to=3&points=100").json;
  const std::string row = csv.body.substr(12, csv.body.find('\n', 12) - 12);
  EXPECT_EQ(std::stod(row.substr(row.rfind(',') + 1)), raw.at("series")[0].at("v")[0].get<double>());
}

TEST_F(DataTest, MarksAreFilteredAndPaged) {
  const Json all = client_->get(path_ + "/marks").json.at("items");
  ASSERT_FALSE(all.empty());
  std::size_t paged = 0;
  std::string cursor;
  do {
    const Json page = client_->get(path_ + "/marks?limit=7" + (cursor.empty() ? "" : "&cursor=" + cursor)).json;
    paged += page.at("items").size();
    cursor = page.at("next").is_null() ? "" : page.at("next").get<std::string>();
  } while (!cursor.empty());
  EXPECT_EQ(paged, all.size());
  const Json states = client_->get(path_ + "/marks?type=state").json.at("items");
  ASSERT_EQ(states.size(), 2u);
  EXPECT_EQ(states[0].at("code"), "running");
  EXPECT_EQ(states[1].at("code"), "finished");
  const Json faults = client_->get(path_ + "/marks?type=fault&from=2&to=2&lane=consensus").json.at("items");
  EXPECT_FALSE(faults.empty());
  for (const Json& mark : faults) {
    EXPECT_EQ(mark.at("k"), 2);
    EXPECT_EQ(mark.at("lane"), "consensus");
  }
  for (const char* query : {"type=nosuch", "from=x", "limit=0", "cursor=zz"}) {
    SCOPED_TRACE(query);
    expect_problem(client_->get(path_ + "/marks?" + query), 400);
  }
}

TEST_F(DataTest, AStreamTellsTheRunAndItsEnd) {
  const std::string live =
      client_->start({{"scenario", "consensus"}, {"pace", 40}, {"patch", {{"time", {{"steps", 60}}}}}});
  httplib::Client viewer("127.0.0.1", client_->port());
  viewer.set_read_timeout(60);
  std::string seen;
  viewer.Get(("/api/v1/runs/" + live + "/stream?topic=lane:consensus").c_str(),
             [&](const char* data, std::size_t size) {
               seen.append(data, size);
               return true;
             });
  EXPECT_NE(seen.find("event: hello"), std::string::npos);
  EXPECT_NE(seen.find("event: frame"), std::string::npos);
  EXPECT_NE(seen.find("\"code\":\"finished\""), std::string::npos);
  EXPECT_NE(seen.find("event: end"), std::string::npos);
  EXPECT_EQ(client_->get("/api/v1/runs/" + live + "/stream").status, 204);
  const std::string other = client_->start({{"scenario", "consensus"}, {"pace", 1}});
  expect_problem(client_->get("/api/v1/runs/" + other + "/stream?topic=nosuch"), 404);
}

TEST_F(DataTest, TheGlobalStreamTellsStates) {
  httplib::Client viewer("127.0.0.1", client_->port());
  viewer.set_read_timeout(60);
  std::string seen;
  std::thread starter;
  viewer.Get("/api/v1/stream", [&](const char* data, std::size_t size) {
    seen.append(data, size);
    if (!starter.joinable()) starter = std::thread([&] { client_->start({{"scenario", "consensus"}}); });
    return seen.find("\"finished\"") == std::string::npos;
  });
  if (starter.joinable()) starter.join();
  EXPECT_NE(seen.find("event: run"), std::string::npos);
}

}  // namespace
}  // namespace vigil::api_test::data_test
