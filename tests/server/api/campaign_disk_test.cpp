/// A campaign whose log meets a full disk pauses and says why; with room again it goes on to the same results.
#include <sys/resource.h>
#include <sys/wait.h>

#include <csignal>

#include "tests/server/api/fixture.hpp"

namespace vigil::api_test::campaign_disk_test {
namespace {

#define REQUIRE_CHILD(condition) \
  if (!(condition)) return __LINE__ & 0xff;

int limit_files(rlim_t bytes) {
  rlimit limit{};
  getrlimit(RLIMIT_FSIZE, &limit);
  limit.rlim_cur = bytes;
  return setrlimit(RLIMIT_FSIZE, &limit);
}

class FullDisk {
 public:
  explicit FullDisk(const std::string& db) : server_(options(db)) {
    server_.start();
    client_ = std::make_unique<Client>(server_.port());
  }
  std::string begin(std::int64_t runs) const {
    const Json body{{"scenario", "consensus"}, {"patch", {{"time", {{"steps", 3}}}}}, {"runs", runs}, {"threads", 2}};
    return "/api/v1/campaigns/" + client_->post("/api/v1/campaigns", body).json.value("id", "0");
  }
  Json look(const std::string& path) const { return client_->get(path).json; }
  int ask(const std::string& path, const char* state) const { return client_->patch(path, {{"state", state}}).status; }
  bool reaches(const std::string& path, const char* state) const {
    return eventually([&] { return look(path).value("state", "") == state; });
  }
  bool healed() const {
    return eventually([&] { return client_->get("/readyz").status == 200; });
  }

 private:
  static ServerOptions options(const std::string& db) {
    ServerOptions options;
    options.demo = false;
    options.db = db;
    options.front.port = 0;
    options.log.patience_milliseconds = 200;
    options.runs.design.executable = VIGIL_EXECUTABLE;
    return options;
  }
  Server server_;
  std::unique_ptr<Client> client_;
};

int fill_and_free(const std::string& db) {
  FullDisk site(db);
  REQUIRE_CHILD(limit_files(1 << 20) == 0);
  const std::string path = site.begin(1500);
  REQUIRE_CHILD(site.reaches(path, "paused"));
  const Json paused = site.look(path);
  REQUIRE_CHILD(paused.at("error").is_string());
  REQUIRE_CHILD(paused.at("error").get<std::string>().find("cannot be written") != std::string::npos);
  const std::int64_t done = paused.at("progress").at("done");
  REQUIRE_CHILD(done < 1500);
  REQUIRE_CHILD(limit_files(RLIM_INFINITY) == 0);
  REQUIRE_CHILD(site.healed());
  REQUIRE_CHILD(site.look(path).at("state") == "paused");  // nobody asked it to go on
  REQUIRE_CHILD(site.ask(path, "running") == 200);
  REQUIRE_CHILD(site.reaches(path, "finished"));
  REQUIRE_CHILD(site.look(path).at("error").is_null());
  const std::string again = site.begin(1500);
  REQUIRE_CHILD(site.reaches(again, "finished"));
  REQUIRE_CHILD(site.look(path + "/cells/0").at("result") == site.look(again + "/cells/0").at("result"));
  return 0;
}

/// Not even the state can be written: the server knows it all the same, and the log learns it later.
int no_byte_more(const std::string& db) {
  FullDisk site(db);
  const std::string path = site.begin(1'000'000);
  const auto done = [&] { return site.look(path).at("progress").at("done").get<std::int64_t>(); };
  REQUIRE_CHILD(eventually([&] { return done() > 0; }));
  REQUIRE_CHILD(limit_files(4096) == 0);
  REQUIRE_CHILD(site.reaches(path, "paused"));
  const LogReader reader(db);
  REQUIRE_CHILD(reader.campaign(1)->state == "running");
  REQUIRE_CHILD(eventually([&] { return site.ask(path, "running") == 503; }));  // not before it stands
  REQUIRE_CHILD(site.look(path).at("state") == "paused");
  const std::int64_t there = done();
  REQUIRE_CHILD(limit_files(RLIM_INFINITY) == 0);
  REQUIRE_CHILD(eventually([&] { return reader.campaign(1)->state == "paused"; }));
  REQUIRE_CHILD(site.ask(path, "running") == 200);
  REQUIRE_CHILD(eventually([&] { return done() > there; }));
  REQUIRE_CHILD(site.ask(path, "cancelled") == 200);
  REQUIRE_CHILD(reader.campaign(1)->state == "cancelled");
  return 0;
}

/// In a child: the limit is the process's.
void in_a_child(int (*story)(const std::string& db)) {
  const TemporaryFolder folder;
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    int code = 1;
    try {
      code = story(folder.file("a.db"));
    } catch (...) {
      code = 2;
    }
    _exit(code);
  }
  int status = 0;
  ASSERT_EQ(child, waitpid(child, &status, 0));
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << "line (mod 256) " << WEXITSTATUS(status);
}

TEST(CampaignDisk, AFullOnePausesACampaignThatGoesOnToTheSameResults) { in_a_child(fill_and_free); }

TEST(CampaignDisk, WhatTheLogCannotBeToldItLearnsLater) { in_a_child(no_byte_more); }

}  // namespace
}  // namespace vigil::api_test::campaign_disk_test
