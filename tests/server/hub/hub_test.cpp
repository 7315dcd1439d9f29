/// The hub without a socket: what a viewer is given, by a clock of the test's own.
#include "server/hub/hub.hpp"

#include <gtest/gtest.h>

#include "server/hub/viewer.hpp"
#include "tests/server/front/server.hpp"

namespace vigil::test::hub_test {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

class HubTest : public testing::Test {
 protected:
  explicit HubTest(HubOptions options = {}) : hub(with_clock(std::move(options))) {}

  HubOptions with_clock(HubOptions options) {
    options.clock = [this] { return now; };
    return options;
  }
  void tick(std::int64_t k, int signals = 3, milliseconds pause = milliseconds(50)) {
    now += pause;
    hub.frame(1, frame_of(k, signals));
  }
  void mark(std::int64_t k, const std::string& code) {
    Mark mark;
    mark.k = k;
    mark.type = MarkType::attack;
    mark.edge = MarkEdge::begin;
    mark.code = code;
    hub.mark(1, mark);
  }
  std::shared_ptr<Viewer> join(const std::string& last = "", const std::string& topic = "", std::int64_t run = 1) {
    auto attached = hub.attach(run, topic, last);
    EXPECT_EQ(attached.result, Hub::Attach::ok);
    return attached.viewer;
  }
  void collect() {
    hub.collect([](Viewer&) {});
  }
  /// Everything the viewer is given now, without chunk framing.
  std::string read(Viewer& viewer) {
    collect();
    std::string raw;
    iovec parts[4];
    for (int count = viewer.gather(parts, 4); count > 0; count = viewer.gather(parts, 4)) {
      std::size_t bytes = 0;
      for (int i = 0; i < count; ++i) {
        raw.append(static_cast<const char*>(parts[i].iov_base), parts[i].iov_len);
        bytes += parts[i].iov_len;
      }
      viewer.sent(bytes);
    }
    std::string text;
    while (!raw.empty()) {
      const auto line = raw.find("\r\n");
      const std::size_t size = std::stoul(raw.substr(0, line), nullptr, 16);
      text += raw.substr(line + 2, size);
      raw.erase(0, line + 2 + size + 2);
    }
    return text;
  }
  static std::size_t count(const std::string& text, const std::string& what) {
    std::size_t found = 0;
    for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++found;
    return found;
  }
  void open(int signals = 3) { hub.open(1, catalogue_of(signals), overview_of(signals), 0.05); }

  nanoseconds now{1'000'000'000};
  Hub hub;
};

TEST_F(HubTest, SpeaksTheContractsWords) {
  open();
  const std::string epoch = hub.epoch(1);
  const auto viewer = join();
  EXPECT_EQ(read(*viewer), "retry: 1000\nevent: hello\ndata: {\"epoch\":\"" + epoch +
                               "\",\"run\":\"1\",\"topic\":\"overview\",\"resumed\":false,\"from\":-1,\"head\":-1,"
                               "\"dt\":0.05,\"signals\":[0,1,2]}\n\n");
  tick(0);
  mark(1, "dos_fdi");
  tick(1);
  EXPECT_EQ(read(*viewer),
            "id: " + epoch +
                ".0\nevent: frame\ndata: {\"k\":0,\"t\":0,\"n\":1,\"v\":[0,0.5,1]}\n\n"
                "event: mark\ndata: {\"k\":1,\"type\":\"attack\",\"edge\":\"begin\",\"code\":\"dos_fdi\"}\n\n"
                "id: " +
                epoch + ".1\nevent: frame\ndata: {\"k\":1,\"t\":0.05,\"n\":1,\"v\":[1,1.5,2]}\n\n");
  hub.close(1, "finished");
  EXPECT_EQ(read(*viewer).substr(0, 47), "event: end\ndata: {\"state\":\"finished\"}\n\n");
  EXPECT_TRUE(viewer->finished());
  hub.detach(viewer);
  EXPECT_EQ(hub.attach(1, "", "").result, Hub::Attach::ended);
  hub.forget(1);
  EXPECT_EQ(hub.attach(1, "", "").result, Hub::Attach::unknown_run);
}

TEST_F(HubTest, ANewViewerSeesTheNewestTickAtOnce) {
  open();
  for (int k = 0; k < 5; ++k) tick(k);
  const std::string text = read(*join());
  EXPECT_NE(text.find("\"from\":3,\"head\":4"), std::string::npos) << text;
  EXPECT_EQ(count(text, "event: frame"), 1u);
  EXPECT_NE(text.find("\"k\":4,"), std::string::npos);
}

TEST_F(HubTest, ResumesWhereTheViewerWas) {
  open();
  for (int k = 0; k < 10; ++k) {
    tick(k);
    mark(k, "m" + std::to_string(k));
  }
  const std::string text = read(*join(hub.epoch(1) + ".6"));
  EXPECT_NE(text.find("\"resumed\":true,\"from\":6,\"head\":9"), std::string::npos) << text;
  EXPECT_EQ(count(text, "event: frame"), 3u);
  EXPECT_EQ(count(text, "event: gap"), 0u);
  EXPECT_EQ(count(text, "event: mark"), 4u);  // those after frame 6, its own included
  EXPECT_LT(text.find("m6"), text.find("\"k\":7,\"t\""));
  const std::string at_head = read(*join(hub.epoch(1) + ".9"));
  EXPECT_NE(at_head.find("\"resumed\":true"), std::string::npos);
  EXPECT_EQ(count(at_head, "event: frame"), 0u);
}

TEST_F(HubTest, AnotherEpochIsNotResumed) {
  open();
  for (int k = 0; k < 10; ++k) tick(k);
  mark(5, "early");
  for (const std::string last : {"other.4", "other.4000", "nonsense", "a.b.c", ".", "other.-7"}) {
    const std::string text = read(*join(last));
    EXPECT_NE(text.find("\"resumed\":false"), std::string::npos) << last;
    EXPECT_EQ(count(text, "event: gap"), 1u) << last;
    EXPECT_NE(text.find("\"reason\":\"restart\""), std::string::npos);
    EXPECT_EQ(count(text, "early"), 1u);
  }
  EXPECT_NE(read(*join("other.4"))
                .find("{\"from\":5,\"to\":8,\"reason\":\"restart\",\"fill\":\"/api/v1/runs/1/samples?from=5&to=8\"}"),
            std::string::npos);
  EXPECT_NE(read(*join("other.4000")).find("\"from\":0,\"to\":8"), std::string::npos);
}

TEST_F(HubTest, FastRunsAreThinnedToTheNewestTick) {
  open();
  const auto viewer = join();
  read(*viewer);
  for (int k = 0; k < 1000; ++k) tick(k, 3, milliseconds(1));
  now += milliseconds(50);
  const std::string text = read(*viewer);
  const std::size_t frames = count(text, "event: frame");
  EXPECT_GE(frames, 59u);
  EXPECT_LE(frames, 63u);
  EXPECT_NE(text.find("\"k\":999,"), std::string::npos);  // the last tick comes, though no tick follows it
  std::int64_t ticks = 0;
  std::int64_t last = -1;
  for (auto at = text.find("data: "); at != std::string::npos; at = text.find("data: ", at + 1)) {
    const Json data = Json::parse(text.substr(at + 6, text.find('\n', at) - at - 6));
    ticks += data.at("n").get<std::int64_t>();
    EXPECT_EQ(data.at("k").get<std::int64_t>() - data.at("n").get<std::int64_t>(), last);
    last = data.at("k");
  }
  EXPECT_EQ(ticks, 1000);
}

TEST_F(HubTest, PingsCarryTheHead) {
  open();
  const auto viewer = join();
  tick(0);
  read(*viewer);
  now += milliseconds(9'000);
  EXPECT_EQ(read(*viewer), "");
  now += milliseconds(1'000);
  EXPECT_EQ(read(*viewer), "event: ping\ndata: {\"head\":0}\n\n");
  EXPECT_EQ(read(*viewer), "");
}

TEST_F(HubTest, TopicsCarryTheirOwnSignals) {
  hub.open(1, catalogue_of(4), {{"overview", {0}}, {"lane:a", {3, 1, 9}}}, 1.0);
  tick(2, 4);
  const auto viewer = join("", "lane:a");
  EXPECT_NE(read(*viewer).find("\"v\":[3.5,2.5,null]"), std::string::npos);
  EXPECT_EQ(hub.attach(1, "lane:b", "").result, Hub::Attach::unknown_topic);
  EXPECT_NE(read(*join("", "overview")).find("\"v\":[2]"), std::string::npos);
}

TEST_F(HubTest, CountsItsViewers) {
  open();
  EXPECT_EQ(hub.viewers(1), 0u);
  const auto a = join();
  const auto b = join();
  const auto c = join("", "", -1);
  EXPECT_EQ(hub.viewers(1), 2u);
  EXPECT_EQ(hub.viewers(), 3u);
  hub.detach(a);
  hub.detach(a);
  EXPECT_EQ(hub.viewers(1), 1u);
  hub.detach(b);
  hub.detach(c);
  EXPECT_EQ(hub.viewers(), 0u);
}

TEST_F(HubTest, TheGlobalFeedNumbersItsEvents) {
  const std::string epoch = hub.epoch(-1);
  hub.publish("run", Json{{"id", "1"}});
  const auto viewer = join("", "", -1);
  EXPECT_EQ(count(read(*viewer), "event: run"), 0u);
  hub.publish("run", Json{{"id", "2"}, {"bad", "\xff"}});
  EXPECT_EQ(read(*viewer), "id: " + epoch + ".2\nevent: run\ndata: {\"id\":\"2\",\"bad\":\"\xef\xbf\xbd\"}\n\n");
  const std::string resumed = read(*join(epoch + ".1", "", -1));
  EXPECT_NE(resumed.find("\"resumed\":true,\"from\":1,\"head\":2"), std::string::npos) << resumed;
  EXPECT_EQ(count(resumed, "event: run"), 1u);
  const std::string strange = read(*join("other.1", "", -1));
  EXPECT_NE(strange.find("\"resumed\":false"), std::string::npos);
  EXPECT_EQ(count(strange, "event: gap"), 1u);
}

TEST_F(HubTest, UnknownRunsAreIgnored) {
  hub.frame(7, frame_of(0, 1));
  hub.mark(7, Mark());
  hub.close(7, "finished");
  EXPECT_EQ(hub.viewers(7), 0u);
  EXPECT_EQ(hub.epoch(7), "");
  EXPECT_EQ(hub.attach(7, "", "").result, Hub::Attach::unknown_run);
}

class SmallRing : public HubTest {
 protected:
  static HubOptions small() {
    HubOptions options;
    options.ring_frames = 8;
    options.marks = 6;
    options.viewers = 2;
    return options;
  }
  SmallRing() : HubTest(small()) {}
};

TEST_F(SmallRing, AStalledViewerGetsOneGapAndAllMarks) {
  open();
  const auto viewer = join();
  tick(0);
  read(*viewer);
  for (int k = 1; k < 100; ++k) {
    tick(k);
    if (k % 25 == 10) mark(k, "m" + std::to_string(k));
    collect();
  }
  const std::string text = read(*viewer);
  EXPECT_EQ(count(text, "event: gap"), 1u) << text;
  EXPECT_NE(text.find("{\"from\":1,\"to\":98,\"reason\":\"slow\",\"fill\":\"/api/v1/runs/1/samples?from=1&to=98\"}"),
            std::string::npos)
      << text;
  EXPECT_EQ(count(text, "event: mark"), 4u);
  EXPECT_LT(text.find("m10"), text.find("m35"));
  EXPECT_LT(text.find("m85"), text.find("\"k\":99,"));
  EXPECT_EQ(count(text, "event: frame"), 1u);
  tick(100);
  EXPECT_EQ(count(read(*viewer), "event: gap"), 0u);
}

TEST_F(SmallRing, MarksThatAreGoneAreNamedByTheGap) {
  open();
  const auto viewer = join();
  read(*viewer);
  for (int k = 0; k < 100; ++k) {
    tick(k);
    mark(k, "x");
    collect();
  }
  const std::string text = read(*viewer);
  EXPECT_EQ(count(text, "event: gap"), 1u);
  EXPECT_NE(text.find("\"marks\":\"/api/v1/runs/1/marks?from=0&to=98\""), std::string::npos) << text;
  EXPECT_EQ(count(text, "event: mark"), 6u);
}

TEST_F(SmallRing, WhatFellOutOfTheRingIsNotResumed) {
  open();
  for (int k = 0; k < 100; ++k) {
    tick(k);
    if (k == 50) mark(k, "kept");
    collect();
  }
  const std::string text = read(*join(hub.epoch(1) + ".20"));
  EXPECT_NE(text.find("\"resumed\":false"), std::string::npos);
  EXPECT_NE(text.find("{\"from\":21,\"to\":98,\"reason\":\"ring\""), std::string::npos) << text;
  EXPECT_EQ(count(text, "kept"), 1u);
  const std::string later = read(*join(hub.epoch(1) + ".60"));
  EXPECT_EQ(count(later, "kept"), 0u);  // it had that mark
}

TEST_F(SmallRing, OverTheLimitTheHubIsBusy) {
  open();
  const auto a = join();
  const auto b = join();
  const auto full = hub.attach(1, "", "");
  EXPECT_EQ(full.result, Hub::Attach::busy);
  EXPECT_NE(full.text.find("event: busy\ndata: {\"limit\":2}\n\n"), std::string::npos);
  hub.detach(a);
  EXPECT_EQ(hub.attach(1, "", "").result, Hub::Attach::ok);
}

TEST_F(SmallRing, WithoutAReaderTheInboxStaysBounded) {
  open();
  for (int k = 0; k < 10'000; ++k) {
    tick(k);
    mark(k, "x");
  }
  const std::string text = read(*join(hub.epoch(1) + ".9995"));
  EXPECT_NE(text.find("\"resumed\":true"), std::string::npos) << text;
  EXPECT_EQ(count(text, "event: frame"), 4u);
}

class ByteRing : public HubTest {
 protected:
  static HubOptions small() {
    HubOptions options;
    options.ring_bytes = 20'000;
    return options;
  }
  ByteRing() : HubTest(small()) {}
};

TEST_F(ByteRing, EncodedFramesAreBoundedInBytes) {
  hub.open(1, catalogue_of(500), overview_of(500), 1.0);
  const auto quick = join();
  const auto slow = join();
  read(*quick);
  read(*slow);
  std::size_t frames = 0;
  for (int k = 0; k < 50; ++k) {
    tick(k, 500);
    frames += count(read(*quick), "event: frame");
  }
  EXPECT_EQ(frames, 50u);
  const std::string text = read(*slow);
  EXPECT_EQ(count(text, "event: gap"), 1u);
  EXPECT_LT(text.size(), 30'000u);
}

}  // namespace
}  // namespace vigil::test::hub_test
