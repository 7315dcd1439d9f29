/// A whole server on a free port with a log of its own, and a client that talks to it over real sockets.
#pragma once

#include <gtest/gtest.h>
#include <httplib.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "engine/core/json.hpp"
#include "server/api/server.hpp"
#include "tests/server/api/temporary.hpp"

namespace vigil::api_test {

struct Answer {
  int status = 0;
  Json json;
  std::string body;
  httplib::Headers headers;
  std::string header(const std::string& name) const {
    const auto place = headers.find(name);
    return place == headers.end() ? "" : place->second;
  }
};

/// A client of one server; every call is a connection of its own.
class Client {
 public:
  explicit Client(int port) : port_(port) {}

  Answer get(const std::string& path, const httplib::Headers& headers = {}) const {
    auto client = open();
    return read(client.Get(path.c_str(), headers));
  }
  Answer send(const std::string& method, const std::string& path, const std::string& body,
              const std::string& type = "application/json", httplib::Headers headers = {}) const {
    auto client = open();
    if (!type.empty()) headers.emplace("Content-Type", type);
    httplib::Request request;
    request.method = method;
    request.path = path;
    request.headers = std::move(headers);
    request.body = body;
    return read(client.send(request));
  }
  Answer post(const std::string& path, const Json& body, const httplib::Headers& headers = {}) const {
    return send("POST", path, body.dump(), "application/json", headers);
  }
  Answer patch(const std::string& path, const Json& body) const { return send("PATCH", path, body.dump()); }
  Answer remove(const std::string& path) const { return send("DELETE", path, "{}"); }
  int port() const { return port_; }

  /// Starts a run and returns its id.
  std::string start(const Json& body) const {
    const Answer answer = post("/api/v1/runs", body);
    EXPECT_EQ(answer.status, 201) << answer.body;
    return answer.status == 201 ? answer.json.at("id").get<std::string>() : "0";
  }
  std::string state(const std::string& id) const {
    const Answer answer = get("/api/v1/runs/" + id);
    return answer.status == 200 ? answer.json.at("state").get<std::string>()
                                : "status " + std::to_string(answer.status);
  }
  std::int64_t tick(const std::string& id) const {
    return get("/api/v1/runs/" + id).json.at("progress").at("k").get<std::int64_t>();
  }
  bool reaches(const std::string& id, const std::string& wanted) const {
    return eventually([&] { return state(id) == wanted; });
  }

 private:
  httplib::Client open() const {
    httplib::Client client("127.0.0.1", port_);
    client.set_read_timeout(60);
    client.set_connection_timeout(30);
    return client;
  }
  static Answer read(const httplib::Result& result) {
    Answer answer;
    if (!result) return answer;
    answer.status = result->status;
    answer.body = result->body;
    answer.headers = result->headers;
    answer.json = Json::parse(answer.body, nullptr, false);
    return answer;
  }
  int port_;
};

/// 4xx, problem+json, and the pointer among its errors.
inline void expect_problem(const Answer& answer, int status, const std::string& pointer = {}) {
  EXPECT_EQ(answer.status, status) << answer.body;
  EXPECT_EQ(answer.header("Content-Type"), "application/problem+json") << answer.body;
  ASSERT_TRUE(answer.json.is_object()) << answer.body;
  EXPECT_EQ(answer.json.value("status", 0), answer.status);
  EXPECT_FALSE(answer.json.value("detail", "").empty());
  if (pointer.empty()) return;
  bool named = false;
  for (const Json& error : answer.json.value("errors", Json::array()))
    named = named || error.value("pointer", "") == pointer;
  EXPECT_TRUE(named) << "no error at " << pointer << ": " << answer.body;
}

/// A server without a demo, unless the test wants one.
class ApiTest : public ::testing::Test {
 protected:
  void SetUp() override { begin(); }
  void begin() {
    options_.front.port = 0;
    options_.db = folder_.file("vigil.db");
    server_ = std::make_unique<Server>(options_);
    server_->start();
    client_ = std::make_unique<Client>(server_->port());
  }
  void TearDown() override { server_.reset(); }
  ApiTest() {
    options_.demo = false;
    options_.runs.design.executable = VIGIL_EXECUTABLE;  // this one knows no solve-sdp
  }

  TemporaryFolder folder_;
  ServerOptions options_;
  std::unique_ptr<Server> server_;
  std::unique_ptr<Client> client_;
};

}  // namespace vigil::api_test
