/// Viewers over real sockets.
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "tests/server/front/client.hpp"
#include "tests/server/front/server.hpp"

namespace vigil::test::stream_test {
namespace {

using std::chrono::milliseconds;
constexpr const char* kStream = "/api/v1/runs/1/stream";

/// A clock that stands: time passes by the test's hand, so nothing is thinned by accident.
struct HandClock {
  std::shared_ptr<std::atomic<std::int64_t>> now = std::make_shared<std::atomic<std::int64_t>>(1'000'000'000);
  std::function<std::chrono::nanoseconds()> clock() const {
    return [now = now] { return std::chrono::nanoseconds(now->load()); };
  }
  void pass(milliseconds time) const { *now += std::chrono::nanoseconds(time).count(); }
};

class StreamTest : public testing::Test {
 protected:
  void start(ServerOptions options = {}, int signals = 3) {
    signals_ = signals;
    options.hub.clock = clock_.clock();
    options.hub.ping = std::chrono::hours(1);
    server = std::make_unique<Server>(std::move(options));
    server->hub.open(1, catalogue_of(signals), overview_of(signals), 0.05);
  }
  void tick(std::int64_t k) {
    clock_.pass(milliseconds(50));
    server->hub.frame(1, frame_of(k, signals_));
  }
  Client join(const std::string& lines = "", int receive_buffer = 0, const std::string& path = kStream) {
    Client client(server->port(), receive_buffer);
    client.send(get(path, lines));
    return client;
  }

  HandClock clock_;
  int signals_ = 3;
  std::unique_ptr<Server> server;
};

TEST_F(StreamTest, FramesComeInOrderUntilTheEnd) {
  start();
  Client client = join();
  EXPECT_EQ(client.event().name, "hello");
  for (int k = 0; k < 200; ++k) tick(k);
  for (int k = 0; k < 200; ++k) {
    const Event event = client.event();
    ASSERT_EQ(event.name, "frame");
    ASSERT_EQ(event.id, server->hub.epoch(1) + "." + std::to_string(k));
    ASSERT_EQ(Json::parse(event.data).at("k"), k);
  }
  server->hub.close(1, "finished");
  EXPECT_EQ(client.event().data, "{\"state\":\"finished\"}");
  EXPECT_EQ(client.event().name, "");
  EXPECT_TRUE(client.stream_whole());
  EXPECT_TRUE(client.closed());
  EXPECT_EQ(Client(server->port()).ask(get(kStream)).status, 204);
  EXPECT_TRUE(eventually([&] { return server->hub.viewers() == 0; }));
}

TEST_F(StreamTest, HeadersSuitAStream) {
  start();
  Client client(server->port());
  client.send("GET " + std::string(kStream) + " HTTP/1.1\r\nHost: localhost\r\n\r\n");
  ASSERT_TRUE(eventually([&] { return server->hub.viewers(1) == 1; }));
  server->hub.close(1, "finished");
  const Reply reply = client.reply();
  EXPECT_EQ(reply.header("content-type"), "text/event-stream");
  EXPECT_EQ(reply.header("cache-control"), "no-store");
  EXPECT_EQ(reply.header("x-accel-buffering"), "no");
  EXPECT_NE(reply.header("content-security-policy"), "");
}

TEST_F(StreamTest, ResumesByHeaderOrQuery) {
  start();
  for (int k = 0; k < 10; ++k) tick(k);
  const std::string id = server->hub.epoch(1) + ".7";
  Client by_header = join("Last-Event-ID: " + id + "\r\n");
  Client by_query = join("", 0, std::string(kStream) + "?topic=overview&lastEventId=" + id);
  for (Client* client : {&by_header, &by_query}) {
    EXPECT_EQ(Json::parse(client->event().data).at("resumed"), true);
    EXPECT_EQ(Json::parse(client->event().data).at("k"), 8);
    EXPECT_EQ(Json::parse(client->event().data).at("k"), 9);
  }
}

TEST_F(StreamTest, UnknownRunsTopicsAndIds) {
  start();
  EXPECT_EQ(Client(server->port()).ask(get("/api/v1/runs/2/stream")).status, 404);
  EXPECT_EQ(Client(server->port()).ask(get("/api/v1/runs/x/stream")).status, 404);
  EXPECT_EQ(Client(server->port()).ask(get(std::string(kStream) + "?topic=none")).status, 404);
  EXPECT_EQ(Client(server->port()).ask(get(kStream, "Origin: http://evil.example\r\n")).status, 403);
}

TEST_F(StreamTest, AStalledViewerGetsOneGapAndDelaysNobody) {
  ServerOptions options;
  options.hub.ring_frames = 64;
  start(options, 1000);
  Client stalled = join("", 4096);
  Client quick = join();
  EXPECT_EQ(quick.event().name, "hello");
  EXPECT_EQ(stalled.stream_status(), 200);
  constexpr int kTicks = 600;
  for (int k = 0; k < kTicks; ++k) {
    tick(k);
    if (k % 100 == 50) {
      Mark mark;
      mark.k = k;
      mark.code = "m" + std::to_string(k);
      server->hub.mark(1, mark);
    }
    // In step with its viewer, so that the quick one has no reason for a gap.
    ASSERT_EQ(Json::parse(quick.event().data).at("k"), k);
    const std::string expected = k % 100 == 50 ? quick.event().name : "mark";
    ASSERT_EQ(expected, "mark");
  }
  server->hub.close(1, "finished");
  EXPECT_EQ(quick.event().name, "end");
  int gaps = 0;
  std::int64_t last = -1;
  std::vector<std::string> marks;
  for (const Event& event : stalled.events_until("end")) {
    ASSERT_NE(event.name, "");
    const Json data = Json::parse(event.data);
    if (event.name == "gap") {
      ++gaps;
      EXPECT_EQ(data.at("from"), last + 1);
      last = data.at("to");
    } else if (event.name == "frame") {
      EXPECT_EQ(data.at("k"), last + 1);
      last = data.at("k");
    } else if (event.name == "mark") {
      marks.push_back(data.at("code"));
    }
  }
  EXPECT_EQ(gaps, 1);
  EXPECT_EQ(last, kTicks - 1);
  EXPECT_EQ(marks, (std::vector<std::string>{"m50", "m150", "m250", "m350", "m450", "m550"}));
}

TEST_F(StreamTest, AViewerThatTakesNothingIsDropped) {
  ServerOptions options;
  options.front.stuck_deadline = milliseconds(300);
  start(options, 1000);
  Client stalled = join("", 4096);
  EXPECT_EQ(stalled.stream_status(), 200);
  std::int64_t k = 0;
  EXPECT_TRUE(eventually([&] {
    for (int i = 0; i < 50; ++i) tick(k++);
    return server->hub.viewers(1) == 0;
  }));
}

TEST_F(StreamTest, TwoHundredViewersSeeEverything) {
  start();
  std::vector<Client> clients;
  for (int i = 0; i < 200; ++i) clients.push_back(join());
  for (auto& client : clients) ASSERT_EQ(client.event().name, "hello");
  EXPECT_EQ(server->hub.viewers(1), 200u);
  for (int k = 0; k < 50; ++k) tick(k);
  for (auto& client : clients) {
    for (int k = 0; k < 50; ++k) ASSERT_EQ(Json::parse(client.event().data).at("k"), k);
  }
  clients.clear();
  EXPECT_TRUE(eventually([&] { return server->hub.viewers() == 0 && server->front->stats().connections == 0; }));
}

TEST_F(StreamTest, OverTheLimitOneIsToldSoAndLetGo) {
  ServerOptions options;
  options.hub.viewers = 1;
  start(options);
  Client first = join();
  EXPECT_EQ(first.event().name, "hello");
  Client second = join();
  EXPECT_EQ(second.stream_status(), 200);
  EXPECT_EQ(second.event().name, "busy");
  EXPECT_EQ(second.event().name, "");
  EXPECT_TRUE(second.stream_whole());
  EXPECT_TRUE(second.closed());
}

TEST_F(StreamTest, PingsWhileNothingHappens) {
  ServerOptions options;
  options.hub.ping = milliseconds(100);
  options.hub.clock = nullptr;
  server = std::make_unique<Server>(std::move(options));
  server->hub.open(1, catalogue_of(1), overview_of(1), 0.05);
  Client client = join();
  EXPECT_EQ(client.event().name, "hello");
  for (int i = 0; i < 3; ++i) EXPECT_EQ(client.event().data, "{\"head\":-1}");
}

TEST_F(StreamTest, TheGlobalFeedHasItsOwnRoute) {
  start();
  Client client = join("", 0, "/api/v1/stream");
  EXPECT_EQ(client.event().name, "hello");
  server->hub.publish("run", Json{{"id", "1"}, {"state", "running"}});
  const Event event = client.event();
  EXPECT_EQ(event.name, "run");
  EXPECT_EQ(event.id, server->hub.epoch(-1) + ".1");
}

TEST_F(StreamTest, PublishersAndViewersComeAndGoTogether) {
  ServerOptions options;
  start(options);
  std::atomic<bool> stop{false};
  std::vector<std::thread> runs;
  for (std::int64_t run = 10; run < 13; ++run) {
    runs.emplace_back([&, run] {
      for (int round = 0; round < 20; ++round) {
        server->hub.open(run, catalogue_of(5), overview_of(5), 0.05);
        for (int k = 0; k < 200; ++k) {
          clock_.pass(milliseconds(1));
          server->hub.frame(run, frame_of(k, 5));
          if (k % 10 == 0) server->hub.mark(run, Mark());
        }
        server->hub.publish("run", Json{{"id", run}});
        server->hub.close(run, "finished");
      }
      stop = true;
    });
  }
  int seen = 0;
  while (!stop) {
    Client client = join("", 0, "/api/v1/runs/" + std::to_string(10 + seen++ % 3) + "/stream");
    if (client.stream_status() == 200) {
      EXPECT_EQ(client.event().name, "hello");
    }
  }
  for (auto& run : runs) run.join();
  EXPECT_TRUE(eventually([&] { return server->hub.viewers() == 0; }));
}

}  // namespace
}  // namespace vigil::test::stream_test
