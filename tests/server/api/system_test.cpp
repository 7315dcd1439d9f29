#include <algorithm>
#include <set>

#include "tests/server/api/fixture.hpp"

namespace vigil::api_test::system_test {
namespace {

using SystemTest = ApiTest;

TEST_F(SystemTest, HealthVersionAndMetrics) {
  EXPECT_EQ(client_->get("/healthz").body, "ok\n");
  EXPECT_EQ(client_->get("/readyz").body, "ready\n");
  const Json server = client_->get("/api/v1/server").json;
  EXPECT_EQ(server.at("version"), std::string(version()));
  EXPECT_EQ(server.at("runs").at("max"), 4);
  EXPECT_TRUE(server.at("demo").is_null());
  EXPECT_EQ(server.at("auth"), false);
  const Answer metrics = client_->get("/metrics");
  EXPECT_EQ(metrics.header("Content-Type"), "text/plain; version=0.0.4; charset=utf-8");
  EXPECT_NE(metrics.body.find("# TYPE vigil_http_requests_total counter\nvigil_http_requests_total "),
            std::string::npos);
  EXPECT_NE(metrics.body.find("vigil_runs{state=\"queued\"} 0\n"), std::string::npos);
}

TEST_F(SystemTest, WithoutABuiltPageTheRootSaysHowToBuildIt) {
  const Answer root = client_->get("/");
  EXPECT_EQ(root.status, 404);
  EXPECT_NE(root.body.find("npm run build"), std::string::npos);
}

TEST_F(SystemTest, ATokenIsAskedForOnceSet) {
  server_.reset();
  options_.front.tokens.full = "0123456789abcdef";
  options_.front.tokens.viewer = "viewer-0123456789";
  begin();
  expect_problem(client_->get("/api/v1/server"), 401);
  expect_problem(client_->get("/metrics"), 401);
  expect_problem(client_->post("/api/v1/runs", {{"scenario", "consensus"}}), 401);
  EXPECT_EQ(client_->get("/healthz").status, 200);
  const httplib::Headers full{{"Authorization", "Bearer 0123456789abcdef"}},
      viewer{{"Authorization", "Bearer viewer-0123456789"}};
  EXPECT_EQ(client_->get("/api/v1/server", full).json.at("auth"), true);
  EXPECT_EQ(client_->get("/api/v1/runs", viewer).status, 200);
  expect_problem(client_->post("/api/v1/runs", {{"scenario", "consensus"}}, viewer), 403);
  EXPECT_EQ(client_->post("/api/v1/runs", {{"scenario", "consensus"}}, full).status, 201);
}

/// Every operation of the description, with something real in its place of every parameter.
class EveryRoute : public SystemTest {
 protected:
  void SetUp() override {
    SystemTest::SetUp();
    run_ = client_->start({{"scenario", "consensus"}, {"pace", 50}, {"patch", {{"time", {{"steps", nullptr}}}}}});
    ASSERT_TRUE(eventually([&] { return client_->tick(run_) > 3; }));
    fed_ = client_->start({{"scenario", "consensus"}, {"input", "ingest"}});
    const Answer trace = client_->send("POST", "/api/v1/traces", "k,t,input.x\n0,0,\n1,1,1\n", "text/csv");
    trace_ = trace.json.value("id", "0");
    client_->post("/api/v1/runs/" + run_ + "/attacks", {{"id", "a1"}, {"type", "dos"}, {"on", {"link:1-2"}}});
    bundle_ = client_->get("/api/v1/runs/" + run_ + "/bundle").body;
    document_ = client_->get("/api/v1/scenarios/consensus").body;
    client_->send("PUT", "/api/v1/scenarios/mine", document_);
    campaign_ = client_->post("/api/v1/campaigns", {{"scenario", "consensus"}, {"runs", 2}}).json.at("id");
    ASSERT_TRUE(
        eventually([&] { return client_->get("/api/v1/campaigns/" + campaign_).json.at("state") == "finished"; }));
    client_->post("/api/v1/papers", {{"only", {"000/fig1"}}, {"runs", 2}});
    ASSERT_TRUE(eventually([&] { return client_->get("/api/v1/papers").json.at("job").at("state") == "finished"; }));
    design_ = client_->post("/api/v1/designs", {{"scenario", "observer-single"}}).json.at("items").at(0).at("key");
  }

  std::string fill(std::string path, const std::string& method) const {
    const bool scenario = path.find("/scenarios/") != std::string::npos;
    const bool trace = path.find("/traces/") != std::string::npos;
    const auto put = [&path](const std::string& name, const std::string& value) {
      const std::size_t place = path.find(name);
      if (place != std::string::npos) path.replace(place, name.size(), value);
    };
    const bool campaign = path.find("/campaigns/") != std::string::npos;
    put("{id}", campaign ? campaign_ : scenario ? (method == "get" ? "consensus" : "mine") : trace ? trace_ : run_);
    put("{run}", fed_);
    put("{aid}", "a1");
    put("{key}", design_);
    put("{cell}", "0");
    put("{index}", "1");
    put("{source}", "000");
    put("{figure}", "fig1");
    put("{method}", "consensus_ekf");
    if (path.ends_with("/compare")) path += "?ids=" + run_ + "," + fed_;
    return path;
  }

  std::string body(const std::string& method, const std::string& path) const {
    if (path.ends_with("/traces")) return "k,t,input.x\n0,0,\n1,1,2\n";
    if (path.ends_with("/traces/map")) return R"({"csv":"a\n1\n","mapping":{"columns":{"input.x":"a"}}})";
    if (path.ends_with("/import")) return bundle_;
    if (path.ends_with("/fork")) return R"({"k":2})";
    if (path.ends_with("/attacks")) return R"({"type":"dos","on":["link:1-2"]})";
    if (path.ends_with("/papers")) return R"({"only":["000/fig1"],"runs":2})";
    if (path.ends_with("/campaigns")) return R"({"scenario":"consensus","runs":2})";
    if (path.ends_with("/runs") || path.ends_with("/designs") || path.ends_with("/systems/check") ||
        path.ends_with("/compatibility"))
      return R"({"scenario":"consensus"})";
    if (method == "put") return document_;
    if (method == "patch") return R"({"note":"x"})";
    if (path.find("/ingest/") != std::string::npos) return R"({"k":0,"values":{}})";
    if (path.ends_with("/session")) return R"({"token":"none"})";
    return "{}";
  }

  int call(const std::string& method, const std::string& pattern) const {
    const std::string path = fill(pattern, method);
    std::string verb = method;
    std::transform(verb.begin(), verb.end(), verb.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    if (pattern.ends_with("/stream")) return stream(path);
    if (method == "get") return client_->get(path).status;
    return client_
        ->send(verb, path, body(method, pattern), pattern.ends_with("/traces") ? "text/csv" : "application/json")
        .status;
  }

  int stream(const std::string& path) const {
    httplib::Client client("127.0.0.1", client_->port());
    client.set_read_timeout(60);
    int status = 0;
    client.Get(
        path.c_str(),
        [&](const httplib::Response& response) {
          status = response.status;
          return true;
        },
        [](const char*, std::size_t) { return false; });
    return status;
  }

  std::string campaign_, run_, fed_, trace_, bundle_, document_, design_;
};

TEST_F(EveryRoute, OfTheDescriptionAnswers) {
  const Json api = client_->get("/api/v1/openapi.json").json;
  EXPECT_EQ(api.at("openapi"), "3.1.0");
  std::vector<std::pair<std::string, std::string>> operations, deletions;
  std::set<std::string> ids;
  for (const auto& [path, methods] : api.at("paths").items()) {
    for (const auto& [method, operation] : methods.items()) {
      EXPECT_TRUE(ids.insert(operation.at("operationId")).second) << operation.at("operationId");
      EXPECT_FALSE(operation.at("summary").get<std::string>().empty());
      EXPECT_TRUE(operation.at("responses").contains("default"));
      (method == "delete" ? deletions : operations).emplace_back(method, path);
    }
  }
  EXPECT_GE(operations.size(), 24u);
  // What is in a thing goes before the thing.
  std::sort(deletions.begin(), deletions.end(),
            [](const auto& a, const auto& b) { return a.second.size() > b.second.size(); });
  operations.insert(operations.end(), deletions.begin(), deletions.end());
  for (const auto& [method, path] : operations) {
    SCOPED_TRACE(method + " " + path);
    const int status = call(method, path);
    // The root is not built here, and without a token there is no session to open.
    const bool by_nature = path == "/" ? status == 404 : path.ends_with("/session") && status == 400;
    EXPECT_TRUE(by_nature || (status >= 200 && status < 300)) << status;
  }
}

TEST_F(EveryRoute, RefusesWhatIsMalformedWithoutAFault) {
  const Json api = client_->get("/api/v1/openapi.json").json;
  for (const auto& [pattern, methods] : api.at("paths").items()) {
    for (const auto& [method, operation] : methods.items()) {
      if (method == "get" || method == "delete") continue;
      for (const char* text : {"{", "[]", "null", "\"x\"", "1e999", "{\"a\":NaN}", "{\"nosuchkey\":1}", "\xff",
                               "{\"k\":-1}", "{\"k\":\"x\"}"}) {
        SCOPED_TRACE(method + " " + pattern + " " + text);
        std::string verb = method;
        std::transform(verb.begin(), verb.end(), verb.begin(),
                       [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
        const Answer answer = client_->send(verb, fill(pattern, method), text,
                                            pattern.ends_with("/traces") ? "text/csv" : "application/json");
        if (pattern.ends_with("/session") && answer.status == 204) continue;
        EXPECT_GE(answer.status, 400);
        EXPECT_LT(answer.status, 500) << answer.body;
        EXPECT_EQ(answer.header("Content-Type"), "application/problem+json");
      }
    }
  }
}

}  // namespace
}  // namespace vigil::api_test::system_test
