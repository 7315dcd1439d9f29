#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/server/front/client.hpp"
#include "tests/server/front/server.hpp"

namespace vigil::test::static_test {
namespace {

namespace fs = std::filesystem;

class StaticTest : public testing::Test {
 protected:
  StaticTest() : folder_(fs::temp_directory_path() / ("vigil-static-" + std::to_string(::getpid()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "page/assets");
    write("secret", "SECRET");
    write("page/index.html", "<!doctype html><title>page</title>");
    write("page/assets/index-Bx3kQ9aZ.js", std::string(5000, ';'));
    write("page/assets/plain.js", "1");
    write("page/favicon.svg", "<svg/>");
    write("page/.hidden", "SECRET");
    fs::create_symlink(folder_ / "secret", folder_ / "page/link.txt");
    fs::create_directory_symlink(folder_, folder_ / "page/up");
    ServerOptions options;
    options.files = StaticFiles(folder_ / "page");
    server_ = std::make_unique<Server>(std::move(options));
  }
  ~StaticTest() override { fs::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }
  Reply ask(const std::string& path, const std::string& lines = "") {
    return Client(server_->port()).ask(get(path, lines));
  }

  fs::path folder_;
  std::unique_ptr<Server> server_;
};

TEST_F(StaticTest, ServesThePageAtItsOwnPaths) {
  for (const char* path : {"/", "/index.html", "/runs", "/runs/17", "/scenarios/consensus/edit"}) {
    const Reply reply = ask(path);
    EXPECT_EQ(reply.status, 200) << path;
    EXPECT_EQ(reply.header("content-type"), "text/html; charset=utf-8");
    EXPECT_EQ(reply.header("cache-control"), "no-cache");
  }
  for (const char* path : {"/api/v1/nothing", "/api", "/missing.js", "/assets/missing.js", "/runs/a.b"})
    EXPECT_EQ(ask(path).status, 404) << path;
  EXPECT_EQ(Client(server_->port()).ask(post("/runs", "{}")).status, 405);
}

TEST_F(StaticTest, HashNamedFilesAreForEver) {
  const Reply reply = ask("/assets/index-Bx3kQ9aZ.js", "Accept-Encoding: gzip\r\n");
  EXPECT_EQ(reply.header("cache-control"), "public, max-age=31536000, immutable");
  EXPECT_EQ(reply.header("content-encoding"), "gzip");
  EXPECT_EQ(reply.header("content-type"), "text/javascript; charset=utf-8");
  EXPECT_EQ(ask("/assets/index-Bx3kQ9aZ.js").body, std::string(5000, ';'));
  EXPECT_EQ(ask("/assets/plain.js").header("cache-control"), "no-cache");
}

TEST_F(StaticTest, KnowsWhatTheBrowserHas) {
  const Reply first = ask("/favicon.svg");
  EXPECT_EQ(first.header("content-type"), "image/svg+xml");
  const Reply second = ask("/favicon.svg", "If-None-Match: " + first.header("etag") + "\r\n");
  EXPECT_EQ(second.status, 304);
  EXPECT_EQ(ask("/favicon.svg", "If-None-Match: \"other\"\r\n").status, 200);
}

TEST_F(StaticTest, NothingLeadsOutOfTheFolder) {
  for (const char* path : {"/link.txt", "/up/secret", "/../secret", "/%2e%2e/secret", "/assets/../../secret",
                           "/.hidden", "//secret", "/..%2fsecret"}) {
    EXPECT_EQ(ask(path).body.find("SECRET"), std::string::npos) << path;
  }
}

TEST(StaticFiles, SaysWhatItCannotRead) { EXPECT_THROW(StaticFiles("/nowhere/at/all"), std::runtime_error); }

}  // namespace
}  // namespace vigil::test::static_test
