#include "server/front/door.hpp"

#include <gtest/gtest.h>

namespace vigil::door_test {
namespace {

constexpr const char* kFull = "full-token-0123456789";
constexpr const char* kViewer = "viewer-token-0123456789";

Routes routes() {
  Routes table;
  Route get;
  get.method = "GET";
  get.pattern = "/api/v1/runs/{id}";
  get.handler = [](const HttpRequest&, HttpResponse&) {};
  table.add(get);
  Route post = get;
  post.method = "POST";
  post.pattern = "/api/v1/runs";
  post.body_limit = 100;
  table.add(post);
  Route remove = get;
  remove.method = "DELETE";
  table.add(remove);
  Route health = get;
  health.pattern = "/healthz";
  health.open = true;
  table.add(health);
  Route stream = get;
  stream.pattern = "/api/v1/stream";
  stream.stream = [](const HttpRequest&) { return StreamTarget{}; };
  table.add(stream);
  Route bare = post;
  bare.pattern = "/api/v1/bare";
  bare.body_types = {};
  table.add(bare);
  return table;
}

struct Case {
  const char* what;
  std::string request;  ///< without the last blank line
  int open;             ///< status where no token is set
  int closed;           ///< status where one is
};

class DoorCases : public testing::TestWithParam<Case> {};

int status(const Case& test, const Tokens& tokens) {
  const Routes table = routes();
  const StaticFiles files;
  const Doorkeeper keeper(tokens);
  const Door door("127.0.0.1", {"lab.example"}, 1000, table, files, keeper);
  Head head;
  const Refusal refusal = parse_head(test.request + "\r\n", HeadLimits(), head);
  if (refusal) return refusal.status;
  const Pass pass = door.check(head, "192.168.1.5");
  return pass.refusal ? pass.refusal.status : pass.options ? 204 : 200;
}

TEST_P(DoorCases, Open) { EXPECT_EQ(status(GetParam(), {}), GetParam().open) << GetParam().request; }
TEST_P(DoorCases, WithTokens) {
  EXPECT_EQ(status(GetParam(), {kFull, kViewer}), GetParam().closed) << GetParam().request;
}

std::string get(const std::string& path, const std::string& lines = "", const std::string& host = "localhost") {
  return "GET " + path + " HTTP/1.1\r\nHost: " + host + "\r\n" + lines;
}

std::string post(const std::string& lines, const std::string& path = "/api/v1/runs") {
  return "POST " + path + " HTTP/1.1\r\nHost: localhost:8080\r\n" + lines;
}

std::string bearer(const std::string& token) { return "Authorization: Bearer " + token + "\r\n"; }

const std::string kJson = "Content-Type: application/json\r\nContent-Length: 2\r\n";
const std::string kRun = "/api/v1/runs/1";

INSTANTIATE_TEST_SUITE_P(
    Table, DoorCases,
    testing::Values(
        Case{"get", get(kRun), 200, 401}, Case{"full", get(kRun, bearer(kFull)), 200, 200},
        Case{"viewer", get(kRun, bearer(kViewer)), 200, 200},
        Case{"wrong", get(kRun, bearer("full-token-0123456780")), 200, 401},
        Case{"prefix", get(kRun, bearer("full-token")), 200, 401},
        Case{"basic", get(kRun, "Authorization: Basic eA==\r\n"), 200, 401},
        Case{"forged session", get(kRun, "Cookie: vigil_session=1\r\n"), 200, 401},
        Case{"health", get("/healthz"), 200, 200}, Case{"unknown", get("/api/v1/nothing"), 404, 401},
        Case{"unknown, full", get("/x", bearer(kFull)), 404, 404},
        Case{"foreign host", get(kRun, "", "evil.example"), 421, 421},
        Case{"foreign host on health", get("/healthz", "", "evil.example"), 421, 421},
        Case{"allowed name", get(kRun, "", "LAB.example:99"), 200, 401},
        Case{"v6", get(kRun, "", "[::1]:8080"), 200, 401},
        Case{"own address", get(kRun, "", "192.168.1.5:8080"), 200, 401},
        Case{"other address", get(kRun, "", "192.168.1.6"), 421, 421},
        Case{"odd host", get(kRun, "", "localhost:80x"), 421, 421}, Case{"odd v6", get(kRun, "", "[::1"), 421, 421},
        Case{"wrong method", "PUT /api/v1/runs/1 HTTP/1.1\r\nHost: localhost\r\n", 405, 401},
        Case{"odd method", "BREW /healthz HTTP/1.1\r\nHost: localhost\r\n", 405, 401},
        Case{"options", "OPTIONS /api/v1/runs HTTP/1.1\r\nHost: localhost\r\n" + bearer(kFull), 204, 204},
        Case{"head", "HEAD /api/v1/runs/1 HTTP/1.1\r\nHost: localhost\r\n" + bearer(kFull), 200, 200},
        Case{"head of a stream", "HEAD /api/v1/stream HTTP/1.1\r\nHost: localhost\r\n" + bearer(kFull), 405, 405},
        Case{"stream, own origin", get("/api/v1/stream", "Origin: http://localhost\r\n" + bearer(kViewer)), 200, 200},
        Case{"stream, foreign origin", get("/api/v1/stream", "Origin: http://evil.example\r\n" + bearer(kViewer)), 403,
             403},
        Case{"get, foreign origin", get(kRun, "Origin: http://evil.example\r\n" + bearer(kFull)), 200, 200},
        Case{"post", post(kJson + bearer(kFull)), 200, 200},
        Case{"post by viewer", post(kJson + bearer(kViewer)), 200, 403},
        Case{"post, own origin", post(kJson + "Origin: https://LOCALHOST:8080\r\n" + bearer(kFull)), 200, 200},
        Case{"post, other port", post(kJson + "Origin: http://localhost:8081\r\n" + bearer(kFull)), 403, 403},
        Case{"post, null origin", post(kJson + "Origin: null\r\n" + bearer(kFull)), 403, 403},
        Case{"form", post("Content-Type: text/plain\r\nContent-Length: 2\r\n" + bearer(kFull)), 415, 415},
        Case{"no type", post("Content-Length: 2\r\n" + bearer(kFull)), 415, 415},
        Case{"charset", post("Content-Type: Application/JSON; charset=utf-8\r\nContent-Length: 2\r\n" + bearer(kFull)),
             200, 200},
        Case{"no length", post("Content-Type: application/json\r\n" + bearer(kFull)), 411, 411},
        Case{"too large", post("Content-Type: application/json\r\nContent-Length: 101\r\n" + bearer(kFull)), 413, 413},
        Case{"bare post", post(bearer(kFull), "/api/v1/bare"), 200, 200},
        Case{"bare post with a body", post(kJson + bearer(kFull), "/api/v1/bare"), 400, 400},
        Case{"get with a body", get(kRun, "Content-Length: 2\r\n" + bearer(kFull)), 400, 400},
        Case{"delete", "DELETE /api/v1/runs/1 HTTP/1.1\r\nHost: localhost\r\n" + bearer(kFull), 200, 200},
        Case{"delete by viewer", "DELETE /api/v1/runs/1 HTTP/1.1\r\nHost: localhost\r\n" + bearer(kViewer), 200, 403},
        Case{"encoded slash", get("/api/v1/runs/a%2fb", bearer(kFull)), 404, 404},
        Case{"bad escape", get("/api/v1/runs/%zz", bearer(kFull)), 404, 404},
        Case{"nul in id", get("/api/v1/runs/%00", bearer(kFull)), 404, 404},
        Case{"empty id", get("/api/v1/runs/", bearer(kFull)), 404, 404}));

TEST(Door, NamesTheMethodsAPathKnows) {
  const Routes table = routes();
  const StaticFiles files;
  const Doorkeeper keeper{Tokens()};
  const Door door("127.0.0.1", {}, 1000, table, files, keeper);
  Head head;
  ASSERT_FALSE(parse_head("PATCH /api/v1/runs/1 HTTP/1.1\r\nHost: localhost\r\n\r\n", HeadLimits(), head));
  const Pass pass = door.check(head, "");
  EXPECT_EQ(pass.refusal.status, 405);
  EXPECT_EQ(pass.headers, (HeaderList{{"Allow", "GET, DELETE, HEAD, OPTIONS"}}));
}

TEST(Routes, LiteralSegmentsWin) {
  Routes table;
  Route one;
  one.method = "GET";
  one.pattern = "/runs/{id}";
  table.add(one);
  one.pattern = "/runs/import";
  table.add(one);
  EXPECT_THROW(table.add(one), std::invalid_argument);
  EXPECT_EQ(table.match("GET", "/runs/import").route->pattern, "/runs/import");
  const auto match = table.match("HEAD", "/runs/%C3%A9%20x");
  ASSERT_TRUE(match.route);
  EXPECT_EQ(match.params.at("id"), "\xc3\xa9 x");
  EXPECT_FALSE(table.match("GET", "/runs").route);
  EXPECT_FALSE(table.match("GET", "/runs/1/").route);
  EXPECT_FALSE(table.match("GET", "/runs/%ff").route);
}

TEST(Doorkeeper, SessionsOpenAndEnd) {
  Doorkeeper keeper({kFull, kViewer});
  const std::string set = keeper.open_session(Access::viewer);
  EXPECT_NE(set.find("HttpOnly; SameSite=Strict"), std::string::npos);
  const std::string cookie = "a=b; " + set.substr(0, set.find(';'));
  EXPECT_EQ(keeper.access("", cookie), Access::viewer);
  EXPECT_NE(keeper.open_session(Access::viewer), set);
  EXPECT_NE(keeper.close_session(cookie).find("Max-Age=0"), std::string::npos);
  EXPECT_EQ(keeper.access("", cookie), Access::none);
}

TEST(Doorkeeper, SecretsCompareAsStringsDo) {
  EXPECT_TRUE(same_secret("abc", "abc"));
  EXPECT_FALSE(same_secret("abd", "abc"));
  EXPECT_FALSE(same_secret("abcd", "abc"));
  EXPECT_FALSE(same_secret("", "abc"));
}

}  // namespace
}  // namespace vigil::door_test
