/// Hostile and broken input over real sockets: each gets its status, and costs no memory.
#include <gtest/gtest.h>
#include <sys/socket.h>

#include <fstream>
#include <random>

#include "tests/server/front/client.hpp"
#include "tests/server/front/server.hpp"

namespace vigil::test::refusal_test {
namespace {

long resident_kilobytes() {
  std::ifstream status("/proc/self/status");
  std::string word;
  long value = 0;
  while (status >> word) {
    if (word == "VmRSS:") status >> value;
  }
  return value;
}

void expect_problem(const Reply& reply, int status) {
  EXPECT_EQ(reply.status, status);
  EXPECT_TRUE(reply.whole);
  EXPECT_EQ(reply.header("content-type"), "application/problem+json");
  const Json problem = Json::parse(reply.body);
  EXPECT_EQ(problem.at("status"), status);
  EXPECT_GT(problem.at("detail").get<std::string>().size(), 10u);
}

struct Case {
  const char* what;
  std::string bytes;
  int status;
};

std::string with(const std::string& lines) { return get("/api/v1/ok", lines); }

std::vector<Case> cases() {
  return {
      {"foreign host", "GET /api/v1/ok HTTP/1.1\r\nHost: evil.example\r\n\r\n", 421},
      {"no host", "GET /api/v1/ok HTTP/1.1\r\nA: b\r\n\r\n", 421},
      {"chunked", post("/api/v1/echo", "", "application/json", "Transfer-Encoding: chunked\r\n"), 411},
      {"negative chunk", "POST /api/v1/echo HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n-2\r\nabc",
       411},
      {"two lengths", post("/api/v1/echo", "abc", "application/json", "Content-Length: 30\r\n"), 400},
      {"gzip body", post("/api/v1/echo", "xyz", "application/json", "Content-Encoding: gzip\r\n"), 415},
      {"forged address", with("REMOTE_ADDR: 10.9.9.9\r\n"), 400},
      {"absolute form", "GET http://localhost/api/v1/ok HTTP/1.1\r\nHost: localhost\r\n\r\n", 400},
      {"climbing", get("/../etc/passwd"), 404},
      {"climbing, encoded", get("/%2e%2e/%2e%2e/etc/passwd"), 404},
      {"unknown path", get("/api/v1/nothing"), 404},
      {"wrong method", "PUT /api/v1/ok HTTP/1.1\r\nHost: localhost\r\nContent-Length: 0\r\n\r\n", 405},
      {"form post", post("/api/v1/echo", "a=b", "application/x-www-form-urlencoded"), 415},
      {"foreign origin", post("/api/v1/echo", "{}", "application/json", "Origin: http://evil.example\r\n"), 403},
      {"too large",
       "POST /api/v1/echo HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nContent-Length: "
       "100000000\r\n\r\n",
       413},
      {"bad query", get("/api/v1/ok?a=%zz"), 400},
      {"not UTF-8 in query", get("/api/v1/ok?a=%ff"), 400},
      {"TLS", "\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03", 400},
      {"HTTP/2", "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n", 505},
      {"malformed JSON", post("/api/v1/json", "{\"a\":"), 400},
      {"deep JSON", post("/api/v1/json", std::string(10'000, '[')), 400},
      {"huge number", post("/api/v1/json", "{\"a\":1e400}"), 400},
      {"NaN", post("/api/v1/json", "{\"a\":NaN}"), 400},
      {"lone surrogate", post("/api/v1/json", "{\"a\":\"\\ud800\"}"), 400},
      {"key twice", post("/api/v1/json", "{\"a\":1,\"a\":2}"), 400},
      {"not an object", post("/api/v1/json", "[1]"), 400},
      {"invalid UTF-8", post("/api/v1/json", "{\"a\":\"\xff\"}"), 400},
      {"no body", post("/api/v1/json", ""), 400},
      {"long path", get("/api/v1/echo/" + std::string(7900, 'a') + "/b"), 404},
      {"input error", get("/api/v1/input"), 422},
      {"bad parameter", get("/api/v1/long?parts=1e3"), 400},
      {"parameter out of range", get("/api/v1/long?parts=-1"), 400},
  };
}

TEST(Refusals, EachGetsOneClearProblem) {
  Server server;
  for (const Case& test : cases()) {
    SCOPED_TRACE(test.what);
    Client client(server.port());
    expect_problem(client.ask(test.bytes), test.status);
  }
  EXPECT_EQ(Client(server.port()).ask(get("/api/v1/ok")).status, 200);
}

TEST(Refusals, CarrySecurityHeadersToo) {
  Server server;
  for (const std::string& bytes : {get("/api/v1/nothing"), get("/api/v1/ok"), get("/api/v1/boom"), get("/healthz")}) {
    Client client(server.port());
    const Reply reply = client.ask(bytes);
    EXPECT_NE(reply.header("content-security-policy").find("default-src 'none'"), std::string::npos);
    EXPECT_EQ(reply.header("x-content-type-options"), "nosniff");
    EXPECT_EQ(reply.header("referrer-policy"), "no-referrer");
    EXPECT_EQ(reply.headers.count("content-security-policy"), 1u);
    EXPECT_EQ(reply.headers.count("access-control-allow-origin"), 0u);
  }
}

TEST(Refusals, ExceptionsDoNotLeakTheirText) {
  Server server;
  for (const char* path : {"/api/v1/boom", "/api/v1/odd"}) {
    Client client(server.port());
    ASSERT_TRUE(client.send(get(path)));
    const Reply reply = client.reply();
    expect_problem(reply, 500);
    EXPECT_EQ(reply.body.find("secret"), std::string::npos);
    for (const auto& [name, value] : reply.headers) EXPECT_EQ(value.find("secret"), std::string::npos);
    EXPECT_NE(reply.body.find(reply.header("x-request-id")), std::string::npos);
  }
}

TEST(Refusals, InputErrorsNameTheField) {
  Server server;
  const Reply reply = Client(server.port()).ask(get("/api/v1/input"));
  const Json error = Json::parse(reply.body).at("errors").at(0);
  EXPECT_EQ(error.at("pointer"), "/a");
  EXPECT_EQ(error.at("allowed"), "1");
}

/// Sends `part` again and again, as long as the server takes it, up to `bytes`.
void flood(int port, const std::string& start, const std::string& part, std::size_t bytes) {
  Client client(port);
  client.send(start);
  for (std::size_t sent = 0; sent < bytes && client.send(part); sent += part.size()) continue;
}

TEST(Refusals, FloodsCostNoMemory) {
  Server server;
  const std::string block(1 << 20, 'a');
  std::string fields;
  while (fields.size() < block.size()) fields += "header-" + std::to_string(fields.size()) + ": v\r\n";
  const std::string chunked = "POST /api/v1/echo HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n";
  flood(server.port(), "GET /", block, 4u << 20);  // so that what is allocated once is there
  const long before = resident_kilobytes();
  flood(server.port(), "GET /", block, 100u << 20);
  flood(server.port(), "GET /api/v1/ok HTTP/1.1\r\n", fields, 100u << 20);
  flood(server.port(), chunked, "100000\r\n" + block + "\r\n", 100u << 20);
  EXPECT_LT(resident_kilobytes() - before, 5 * 1024);
  EXPECT_EQ(Client(server.port()).ask(get("/api/v1/ok")).status, 200);
}

TEST(Refusals, GarbageNeverHurts) {
  Server server;
  std::mt19937 random(15);
  const std::string honest = post("/api/v1/echo?a=b", "{\"a\":1}", "application/json", "Accept: */*\r\n");
  for (int i = 0; i < 600; ++i) {
    std::string bytes = honest;
    const int changes = 1 + static_cast<int>(random() % 12);
    for (int change = 0; change < changes; ++change) bytes[random() % bytes.size()] = static_cast<char>(random());
    if (i % 5 == 0) {
      bytes.assign(random() % 3000, '\0');
      for (char& c : bytes) c = static_cast<char>(random());
    }
    Client client(server.port());
    client.send(bytes);
    ::shutdown(client.socket(), 1);
    const Reply reply = client.reply();
    EXPECT_TRUE(reply.status < 500 || reply.status == 505) << reply.status;
  }
  EXPECT_EQ(Client(server.port()).ask(honest).status, 200);
}

}  // namespace
}  // namespace vigil::test::refusal_test
