// Announcements on their way to a sink that the test plays.
#include <gtest/gtest.h>

#include <atomic>

#include "server/alarms/announcer.hpp"
#include "tests/server/api/fixture.hpp"

namespace vigil::outbox_test {
namespace {

using api_test::eventually;

/// What the sink shares with the test, which outlives it.
struct Heard {
  std::mutex mutex;
  std::vector<Announcement> all;
  std::vector<std::pair<std::string, std::string>> kept;
  std::atomic<bool> connected{true}, fails{false};
  std::atomic<std::uint64_t> connections{1};

  std::vector<Announcement> of(const std::string& topic) {
    const std::lock_guard lock(mutex);
    std::vector<Announcement> some;
    for (const Announcement& one : all)
      if (one.topic == topic) some.push_back(one);
    return some;
  }
  std::string newest(const std::string& topic) {
    const auto some = of(topic);
    return some.empty() ? "none" : some.back().text;
  }
};

class FakeSink : public AlarmSink {
 public:
  explicit FakeSink(Heard& heard) : heard_(heard) {}
  std::string name() const override { return "fake"; }
  bool send(const Announcement& announcement) override {
    if (heard_.fails) return false;
    const std::lock_guard lock(heard_.mutex);
    heard_.all.push_back(announcement);
    return true;
  }
  bool connected() const override { return heard_.connected; }
  std::uint64_t connections() const override { return heard_.connections; }
  std::vector<std::pair<std::string, std::string>> kept() override {
    const std::lock_guard lock(heard_.mutex);
    return std::exchange(heard_.kept, {});
  }
  Json status() const override { return Json::object(); }

 private:
  Heard& heard_;
};

class AnnouncerTest : public ::testing::Test {
 protected:
  AnnouncerTest() {
    std::vector<std::unique_ptr<AlarmSink>> sinks;
    sinks.push_back(std::make_unique<FakeSink>(heard_));
    AnnouncerOptions options;
    options.queue = 4;
    options.logged = [](RunId run) { return run == 8 ? std::optional<std::string>("interrupted") : std::nullopt; };
    announcer_ = std::make_unique<Announcer>(std::move(sinks), std::move(options));
  }
  static Mark mark(std::int64_t k, MarkEdge edge, const char* node = "1") {
    Mark mark;
    mark.k = k;
    mark.type = MarkType::alarm;
    mark.edge = edge;
    mark.lane = "a";
    mark.node = node;
    return mark;
  }
  Json state() {
    const std::string text = heard_.newest("runs/7/state");
    return text == "none" ? Json::object() : Json::parse(text);
  }
  void begin(const char* state = "running") {
    announcer_->state(7, {{"id", "7"}, {"state", state}, {"k", 0}}, {"a", "b"});
  }

  Heard heard_;
  std::unique_ptr<Announcer> announcer_;
};

TEST_F(AnnouncerTest, AStateKnowsItsLanesAlarms) {
  begin();
  announcer_->alarm(7, mark(3, MarkEdge::begin, "1"));
  announcer_->alarm(7, mark(4, MarkEdge::begin, "2"));
  ASSERT_TRUE(eventually([&] { return state().value("k", 0) == 4; }));
  EXPECT_EQ(state().at("lanes"), (Json{{"a", {{"alarm", true}, {"since", {{"1", 3}, {"2", 4}}}}},
                                       {"b", {{"alarm", false}, {"since", Json::object()}}}}));
  announcer_->alarm(7, mark(5, MarkEdge::end, "1"));
  announcer_->alarm(7, mark(6, MarkEdge::end, "2"));
  ASSERT_TRUE(eventually([&] { return state().value("k", 0) == 6; }));
  EXPECT_EQ(state().at("lanes").at("a").at("alarm"), false);
  ASSERT_TRUE(eventually([&] { return heard_.of("runs/7/alarms").size() == 4; }));
  EXPECT_EQ(Json::parse(heard_.of("runs/7/alarms")[0].text).at("edge"), "begin");
  EXPECT_FALSE(heard_.of("runs/7/alarms")[0].kept);
  EXPECT_TRUE(heard_.of("runs/7/state")[0].kept);
}

TEST_F(AnnouncerTest, WhatDoesNotFitIsCountedAndTheNewestStateStays) {
  heard_.fails = true;
  begin();
  for (int k = 0; k < 50; ++k) announcer_->alarm(7, mark(k, k % 2 == 0 ? MarkEdge::begin : MarkEdge::end));
  begin("finished");
  heard_.fails = false;
  ASSERT_TRUE(eventually([&] { return state().value("state", "") == "finished"; }));
  ASSERT_TRUE(eventually([&] { return announcer_->status().at("fake").at("waiting") == 0; }));
  const auto alarms = heard_.of("runs/7/alarms");
  const auto dropped = announcer_->status().at("fake").at("dropped").get<std::size_t>();
  EXPECT_EQ(alarms.size() + dropped, 50u);
  EXPECT_GE(dropped, 45u);
  EXPECT_EQ(Json::parse(alarms.back().text).at("k"), 49);
}

TEST_F(AnnouncerTest, ABrokerThatComesBackHearsWhatIsKept) {
  begin();
  ASSERT_TRUE(eventually([&] { return heard_.of("runs/7/state").size() == 1; }));
  heard_.connections = 2;
  EXPECT_TRUE(eventually([&] { return heard_.of("runs/7/state").size() == 2; }));
  announcer_->forget(7);
  EXPECT_TRUE(eventually([&] { return heard_.newest("runs/7/state").empty(); }));
}

TEST_F(AnnouncerTest, WhatIsKeptOfRunsThatAreOverIsMadeRight) {
  begin();
  {
    const std::lock_guard lock(heard_.mutex);
    heard_.kept = {{"runs/7/state", R"({"state":"running"})"},
                   {"runs/8/state", R"({"state":"running","k":5})"},
                   {"runs/9/state", R"({"state":"running"})"},
                   {"runs/x/state", "nonsense"}};
  }
  EXPECT_TRUE(eventually([&] { return heard_.newest("runs/9/state").empty(); })) << "it was deleted";
  ASSERT_TRUE(eventually([&] { return heard_.of("runs/8/state").size() == 1; }));
  EXPECT_EQ(Json::parse(heard_.newest("runs/8/state")).at("state"), "interrupted");
  EXPECT_EQ(heard_.of("runs/7/state").size(), 1u) << "it is live";
  EXPECT_TRUE(heard_.of("runs/x/state").empty());
}

TEST_F(AnnouncerTest, TheEndSendsWhatWaitsAndWaitsForNobody) {
  begin();
  begin("stopped");
  announcer_.reset();
  EXPECT_EQ(state().value("state", ""), "stopped");
}

}  // namespace
}  // namespace vigil::outbox_test
