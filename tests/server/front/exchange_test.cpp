/// Ordinary exchanges: keep-alive, pipelining, HEAD, OPTIONS, bodies, long answers, tokens.
#include <gtest/gtest.h>
#include <sys/socket.h>

#include "tests/server/front/client.hpp"
#include "tests/server/front/server.hpp"

namespace vigil::test::exchange_test {
namespace {

TEST(Exchange, KeepsTheConnection) {
  Server server;
  Client client(server.port());
  for (int i = 0; i < 5; ++i) {
    const Reply reply = client.ask(get("/api/v1/ok"));
    EXPECT_EQ(reply.status, 200);
    EXPECT_EQ(reply.body, "{\"ok\":true}");
  }
  EXPECT_EQ(client.ask(get("/api/v1/nothing")).status, 404);
  EXPECT_EQ(client.ask(get("/api/v1/ok", "Connection: close\r\n")).status, 200);
  EXPECT_TRUE(client.closed());
}

TEST(Exchange, AnswersPipelinedRequestsInOrder) {
  Server server;
  Client client(server.port());
  std::string all;
  for (int i = 0; i < 20; ++i)
    all += i % 3 == 2 ? get("/nothing/" + std::to_string(i)) : get("/api/v1/echo/" + std::to_string(i));
  all += post("/api/v1/echo", "{\"last\":true}");
  ASSERT_TRUE(client.send(all));
  for (int i = 0; i < 20; ++i) {
    const Reply reply = client.reply();
    ASSERT_EQ(reply.status, i % 3 == 2 ? 404 : 200) << i;
    if (i % 3 != 2) {
      EXPECT_EQ(Json::parse(reply.body).at("params").at("name"), std::to_string(i));
    }
  }
  EXPECT_EQ(Json::parse(client.reply().body).at("body"), "{\"last\":true}");
}

TEST(Exchange, TakesARequestByteByByte) {
  Server server;
  Client client(server.port());
  for (const char c : post("/api/v1/echo", "{\"a\":1}")) ASSERT_TRUE(client.send(std::string(1, c)));
  EXPECT_EQ(Json::parse(client.reply().body).at("body"), "{\"a\":1}");
}

TEST(Exchange, DecodesParametersAndQuery) {
  Server server;
  const Reply reply = Client(server.port()).ask(get("/api/v1/echo/a%20%C3%A9?x=1+2&y=%26&z"));
  const Json json = Json::parse(reply.body);
  EXPECT_EQ(json.at("params").at("name"), "a \xc3\xa9");
  EXPECT_EQ(json.at("query"), (Json{{"x", "1 2"}, {"y", "&"}, {"z", ""}}));
  EXPECT_EQ(json.at("remote"), "127.0.0.1");
  EXPECT_EQ(json.at("forged"), "");
}

TEST(Exchange, HeadHasNoBody) {
  Server server;
  Client client(server.port());
  ASSERT_TRUE(client.send(
      "HEAD /api/v1/ok HTTP/1.1\r\nHost: localhost\r\n\r\nHEAD /nothing HTTP/1.1\r\nHost: localhost\r\n\r\n" +
      get("/api/v1/ok")));
  const Reply head = client.reply(true);
  EXPECT_EQ(head.status, 200);
  EXPECT_EQ(head.header("content-length"), "11");
  EXPECT_EQ(client.reply(true).status, 404);
  EXPECT_EQ(client.reply().body, "{\"ok\":true}");
}

TEST(Exchange, OptionsNamesMethodsAndGrantsNothing) {
  Server server;
  const Reply reply =
      Client(server.port())
          .ask("OPTIONS /api/v1/echo/a HTTP/1.1\r\nHost: localhost\r\nOrigin: http://evil.example\r\n\r\n");
  EXPECT_EQ(reply.status, 204);
  EXPECT_EQ(reply.header("allow"), "GET, DELETE, HEAD, OPTIONS");
  EXPECT_EQ(reply.headers.count("content-length"), 0u);
  EXPECT_EQ(reply.headers.count("access-control-allow-origin"), 0u);
}

TEST(Exchange, AsksForTheBodyWhenTheClientWaits) {
  Server server;
  Client client(server.port());
  const std::string body(100'000, 'b');
  const std::string whole = post("/api/v1/echo", body, "text/csv", "Expect: 100-continue\r\n");
  ASSERT_TRUE(client.send(whole.substr(0, whole.size() - body.size())));
  char begin[32] = "";
  ASSERT_GT(::recv(client.socket(), begin, 25, MSG_WAITALL), 0);
  EXPECT_STREQ(begin, "HTTP/1.1 100 Continue\r\n\r\n");
  ASSERT_TRUE(client.send(body));
  EXPECT_EQ(Json::parse(client.reply().body).at("body"), body);
}

TEST(Exchange, PacksLongTextForThoseWhoTakeIt) {
  Server server;
  Client client(server.port());
  const std::string body(50'000, 'b');
  const Reply packed = client.ask(post("/api/v1/echo", body, "text/csv", "Accept-Encoding: br, gzip\r\n"));
  EXPECT_EQ(packed.header("content-encoding"), "gzip");
  EXPECT_LT(packed.body.size(), 2000u);
  EXPECT_EQ(packed.body.substr(0, 2), "\x1f\x8b");
  EXPECT_EQ(
      client.ask(post("/api/v1/echo", body, "text/csv", "Accept-Encoding: gzip;q=0\r\n")).header("content-encoding"),
      "");
}

TEST(Exchange, StreamsLongBodies) {
  Server server;
  Client client(server.port());
  const Reply small = client.ask(get("/api/v1/long?parts=3"));
  EXPECT_EQ(small.body.size(), 30'000u);
  const Reply large = client.ask(get("/api/v1/long?parts=2000"));
  EXPECT_TRUE(large.whole);
  EXPECT_EQ(large.body.size(), 20'000'000u);
  EXPECT_EQ(large.header("content-type"), "text/csv");
  EXPECT_EQ(client.ask(get("/api/v1/ok")).status, 200);
}

TEST(Exchange, ACutBodyNeverLooksWhole) {
  Server server;
  for (const char* path : {"/api/v1/long?parts=3&cut", "/api/v1/long?parts=300&cut"}) {
    const Reply reply = Client(server.port()).ask(get(path));
    EXPECT_EQ(reply.status, 200);
    EXPECT_FALSE(reply.whole);
    EXPECT_EQ(reply.body.find("secret"), std::string::npos);
  }
}

TEST(Exchange, SlowReadersOfLongBodiesDoNotTakeAllWorkers) {
  ServerOptions options;
  options.front.workers = 4;
  Server server(options);
  std::vector<Client> readers;
  for (int i = 0; i < 8; ++i) {
    readers.emplace_back(server.port(), 4096);
    ASSERT_TRUE(readers.back().send(get("/api/v1/long?parts=2000")));
  }
  EXPECT_EQ(Client(server.port()).ask(get("/api/v1/ok")).status, 200);
  int served = 0;
  int refused = 0;
  for (auto& reader : readers) {
    const Reply reply = reader.reply();
    (reply.status == 200 ? served : refused) += 1;
    EXPECT_TRUE(reply.status == 200 || reply.status == 503) << reply.status;
  }
  EXPECT_GE(served, 2);
  EXPECT_GE(refused, 1);
}

TEST(Exchange, AFullQueueSaysComeBack) {
  ServerOptions options;
  options.front.workers = 1;
  options.front.queue = 2;
  Server server(options);
  std::vector<Client> waiting;
  for (int i = 0; i < 3; ++i) {
    waiting.emplace_back(server.port());
    ASSERT_TRUE(waiting.back().send(get("/api/v1/wait")));
    ASSERT_TRUE(eventually(
        [&] { return server.gate.waiting() == 1 && server.front->stats().queued == static_cast<std::size_t>(i); }));
  }
  Client late(server.port());
  const Reply reply = late.ask(get("/api/v1/ok"));
  EXPECT_EQ(reply.status, 503);
  EXPECT_EQ(reply.header("retry-after"), "1");
  server.gate.open();
  for (auto& client : waiting) EXPECT_EQ(client.reply().status, 200);
  EXPECT_EQ(late.ask(get("/api/v1/ok")).status, 200);
}

TEST(Exchange, TokensCookiesAndViewers) {
  ServerOptions options;
  options.front.tokens = {"full-token-0123456789", "viewer-token-0123456789"};
  Server server(options);
  Client client(server.port());
  EXPECT_EQ(client.ask(get("/healthz")).status, 200);
  const Reply none = client.ask(get("/api/v1/ok"));
  EXPECT_EQ(none.status, 401);
  EXPECT_NE(none.header("www-authenticate"), "");
  const std::string viewer = "Authorization: Bearer viewer-token-0123456789\r\n";
  EXPECT_EQ(client.ask(get("/api/v1/ok", viewer)).status, 200);
  const std::string session = "POST /api/v1/session HTTP/1.1\r\nHost: localhost\r\n";
  EXPECT_EQ(client.ask(session + "\r\n").status, 401);
  const Reply opened = client.ask(session + viewer + "\r\n");
  EXPECT_EQ(opened.status, 200);
  const std::string cookie =
      "Cookie: " + opened.header("set-cookie").substr(0, opened.header("set-cookie").find(';')) + "\r\n";
  EXPECT_EQ(client.ask(get("/api/v1/ok", cookie)).status, 200);
  EXPECT_EQ(Client(server.port()).ask(post("/api/v1/json", "{}", "application/json", cookie)).status, 403);
  EXPECT_EQ(client.ask("DELETE /api/v1/session HTTP/1.1\r\nHost: localhost\r\n" + cookie + "\r\n").status, 204);
  EXPECT_EQ(client.ask(get("/api/v1/ok", cookie)).status, 401);
  const std::string full = "Authorization: Bearer full-token-0123456789\r\n";
  EXPECT_EQ(client.ask(post("/api/v1/json", "{}", "application/json", full)).status, 200);
}

}  // namespace
}  // namespace vigil::test::exchange_test
