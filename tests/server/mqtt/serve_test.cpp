// The options of `vigil serve` that name a broker.
#include <gtest/gtest.h>

#include "server/plant/mqtt.hpp"
#include "tests/server/api/temporary.hpp"
#include "tests/server/cli/command.hpp"

namespace vigil::mqtt_test {
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
}  // namespace vigil::mqtt_test
