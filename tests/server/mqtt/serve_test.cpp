// The options of `vigil serve` that name a broker.
#include <arpa/inet.h>
#include <sys/socket.h>

#include <csignal>

#include "server/plant/mqtt.hpp"
#include "tests/server/api/fixture.hpp"
#include "tests/server/cli/command.hpp"

namespace vigil::mqtt_test::serve_test {
namespace {

using api_test::vigil_command;

void expect_refused(const std::vector<std::string>& more, const std::string& named) {
  const api_test::TemporaryFolder folder;
  std::vector<std::string> arguments{"serve", "--port", "0", "--no-demo", "--db", folder.file("log.db")};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const api_test::Outcome outcome = vigil_command(arguments);
  EXPECT_EQ(outcome.code, 2) << outcome.error;
  EXPECT_EQ(outcome.output, "");
  EXPECT_NE(outcome.error.find(named), std::string::npos) << outcome.error;
}

TEST(ServeMqtt, WithoutTheLibraryItSaysWhatIsMissing) {
  if (mqtt_missing().empty()) GTEST_SKIP() << "it is here";
  expect_refused({"--mqtt", "tcp://localhost"}, "libpaho-mqttpp-dev");
}

TEST(ServeMqtt, ItEndsCleanlyWhileABrokerDoesNotAnswer) {
  if (!mqtt_missing().empty()) GTEST_SKIP() << mqtt_missing();
  const int silent = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);  // takes connections and never says a word
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  ASSERT_EQ(bind(silent, reinterpret_cast<sockaddr*>(&address), size), 0);
  ASSERT_EQ(listen(silent, 16), 0);
  getsockname(silent, reinterpret_cast<sockaddr*>(&address), &size);
  for (const std::string& port : {std::to_string(ntohs(address.sin_port)), std::string("1")}) {
    const api_test::TemporaryFolder folder;
    api_test::ServerProcess server({"--db", folder.file("log.db"), "--no-demo", "--mqtt", "tcp://127.0.0.1:" + port,
                                    "--mqtt-topic", "plant/{run}"});
    const api_test::Client client(server.port());
    EXPECT_EQ(client.get("/api/v1/ingest").json.at("broker").at("connected"), false);
    EXPECT_EQ(server.end(SIGTERM), 0) << port;
  }
  close(silent);
}

TEST(ServeMqtt, WhatCannotBeUsedIsNamed) {
  if (!mqtt_missing().empty()) GTEST_SKIP() << mqtt_missing();
  for (const char* url : {"localhost", "http://localhost", "tcp://", "tcp://host:0", "tcp://host:x", "tcp://u:p@host",
                          "tcp://host/path", "tcp://:1883"})
    expect_refused({"--mqtt", url}, "address");
  expect_refused({"--mqtt", "tcp://localhost", "--mqtt-topic", "a/{nosuch}"}, "nosuch");
  expect_refused({"--mqtt", "tcp://localhost", "--mqtt-prefix", "a/+"}, "prefix");
  expect_refused({"--mqtt", "tcp://localhost", "--mqtt-credentials", "/nosuch/file"}, "/nosuch/file");
  expect_refused({"--mqtt-topic", "a"}, "--mqtt");
}

}  // namespace
}  // namespace vigil::mqtt_test::serve_test
