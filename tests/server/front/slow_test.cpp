/// Clients that are slow, silent, many, or in the way when the server stops.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <thread>

#include "tests/server/front/client.hpp"
#include "tests/server/front/server.hpp"

namespace vigil::test::slow_test {
namespace {

using std::chrono::milliseconds;

TEST(Slow, LoneSlowHeadsCostNobodyAnything) {
  ServerOptions options;
  options.front.workers = 2;
  Server server(options);
  std::vector<Client> slow;
  for (int i = 0; i < 50; ++i) {
    slow.emplace_back(server.port());
    ASSERT_TRUE(slow.back().send("GET /api/v1/ok HTTP/1.1\r\nHost: localhost\r\nX: "));
  }
  std::vector<Client> bodies;
  for (int i = 0; i < 50; ++i) {
    bodies.emplace_back(server.port());
    ASSERT_TRUE(
        bodies.back().send("POST /api/v1/echo HTTP/1.1\r\nHost: localhost\r\nContent-Type: "
                           "application/json\r\nContent-Length: 100\r\n\r\n{"));
  }
  for (int round = 0; round < 20; ++round) {
    for (auto& client : slow) ASSERT_TRUE(client.send("y"));
    for (auto& client : bodies) ASSERT_TRUE(client.send(" "));
    EXPECT_EQ(Client(server.port()).ask(get("/api/v1/ok")).status, 200);
  }
  EXPECT_EQ(server.front->stats().requests, 20u);
  ASSERT_TRUE(slow.front().send("\r\n\r\n"));
  EXPECT_EQ(slow.front().reply().status, 200);
}

TEST(Slow, DeadlinesEndThem) {
  ServerOptions options;
  options.front.head_deadline = milliseconds(300);
  options.front.body_deadline = milliseconds(300);
  options.front.idle_deadline = milliseconds(300);
  Server server(options);
  Client silent(server.port());
  Client head(server.port());
  ASSERT_TRUE(head.send("GET /api/v1/ok HTTP/1.1\r\n"));
  Client body(server.port());
  ASSERT_TRUE(
      body.send("POST /api/v1/echo HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nContent-Length: "
                "100\r\n\r\n{"));
  Client idle(server.port());
  EXPECT_EQ(idle.ask(get("/api/v1/ok")).status, 200);
  EXPECT_EQ(head.reply().status, 408);
  EXPECT_EQ(body.reply().status, 408);
  EXPECT_TRUE(head.closed());
  EXPECT_TRUE(body.closed());
  EXPECT_TRUE(silent.closed());
  EXPECT_TRUE(idle.closed());
  EXPECT_TRUE(eventually([&] { return server.front->stats().connections == 0; }));
}

TEST(Slow, DrippingDoesNotMoveTheDeadline) {
  ServerOptions options;
  options.front.head_deadline = milliseconds(500);
  Server server(options);
  Client client(server.port());
  ASSERT_TRUE(client.send("GET /api/v1/ok HTTP/1.1\r\nHost: localhost\r\nX: "));
  std::atomic<bool> stop{false};
  std::thread drip([&] {
    while (!stop && client.send("y")) std::this_thread::sleep_for(milliseconds(20));
  });
  EXPECT_EQ(client.reply().status, 408);
  stop = true;
  drip.join();
}

TEST(Slow, OneAddressMayHaveOnlySoMany) {
  ServerOptions options;
  options.front.per_address = 5;
  options.front.cap_loopback = true;
  Server server(options);
  std::vector<Client> clients;
  for (int i = 0; i < 5; ++i) {
    clients.emplace_back(server.port());
    EXPECT_EQ(clients.back().ask(get("/api/v1/ok")).status, 200);
  }
  EXPECT_EQ(Client(server.port()).reply().status, 429);
  clients.pop_back();
  EXPECT_TRUE(eventually([&] { return Client(server.port()).ask(get("/api/v1/ok")).status == 200; }));
}

double cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// Runs in a child: the limit of descriptors is the whole process's.
[[noreturn]] void exhaust_descriptors() {
  Server server;
  Client before(server.port());
  before.send(get("/api/v1/stream"));
  if (before.event().name != "hello") _exit(2);
  rlimit limit{};
  getrlimit(RLIMIT_NOFILE, &limit);
  std::vector<int> hoard;
  limit.rlim_cur = 64;
  setrlimit(RLIMIT_NOFILE, &limit);
  for (int fd = ::dup(0); fd >= 0; fd = ::dup(0)) hoard.push_back(fd);
  ::close(hoard.back());
  hoard.pop_back();
  Client waiting(server.port());  // takes the last descriptor: the server cannot accept it
  if (!waiting.send(get("/api/v1/ok"))) _exit(3);
  const double start = cpu_seconds();
  std::this_thread::sleep_for(milliseconds(1000));
  if (cpu_seconds() - start > 0.5) _exit(4);  // half of what a busy loop takes
  server.hub.publish("still", Json::object());
  if (before.event().name != "still") _exit(5);
  for (const int fd : hoard) ::close(fd);
  _exit(waiting.reply().status == 200 ? 0 : 6);
}

TEST(Slow, WithoutDescriptorsAcceptingPauses) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "UBSan's vptr check opens a pipe of its own: without descriptors it reports what is not there";
#endif
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  EXPECT_EXIT(exhaust_descriptors(), testing::ExitedWithCode(0), "");
}

TEST(Stop, EndsWithEverybodyInTheWay) {
  Server server;
  server.hub.open(1, catalogue_of(200), overview_of(200), 0.05);
  Client viewer(server.port());
  ASSERT_TRUE(viewer.send(get("/api/v1/runs/1/stream")));
  EXPECT_EQ(viewer.event().name, "hello");
  Client stalled(server.port(), 4096);
  ASSERT_TRUE(stalled.send(get("/api/v1/runs/1/stream")));
  Client head(server.port());
  ASSERT_TRUE(head.send("GET / HTTP/1.1\r\n"));
  Client idle(server.port());
  EXPECT_EQ(idle.ask(get("/api/v1/ok")).status, 200);
  Client working(server.port());
  ASSERT_TRUE(working.send(get("/api/v1/wait")));
  ASSERT_TRUE(eventually([&] { return server.gate.waiting() == 1; }));
  std::thread stop([&] { server.front->stop(); });
  EXPECT_EQ(viewer.event().name, "");
  EXPECT_TRUE(viewer.stream_whole());
  EXPECT_TRUE(head.closed());
  EXPECT_TRUE(idle.closed());
  server.gate.open();
  EXPECT_EQ(working.reply().status, 200);
  EXPECT_TRUE(working.closed());
  stop.join();
  EXPECT_EQ(server.hub.viewers(), 0u);
  EXPECT_THROW(Client late(server.port()), std::runtime_error);
}

TEST(Start, SaysWhyThePortCannotBeHad) {
  Server first;
  FrontOptions options;
  options.port = first.port();
  Hub hub;
  Front second(options, Routes(), hub);
  try {
    second.start();
    FAIL() << "two servers on one port";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("Address already in use"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace vigil::test::slow_test
