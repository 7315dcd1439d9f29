// A broker behind TLS that asks who one is, with an authority of our own.
#include <sys/wait.h>

#include <cstdlib>
#include <fstream>

#include "tests/server/cli/command.hpp"
#include "tests/server/mqtt/fixture.hpp"

namespace vigil::mqtt_test::tls_test {
namespace {

using api_test::eventually;

class TlsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (const std::string reason = why_not(); !reason.empty()) GTEST_SKIP() << reason;
    if (std::system("openssl version >/dev/null 2>&1") != 0) GTEST_SKIP() << "openssl is not installed";
    make_authority("ca");
    make_authority("other");
    sign("server", "/CN=broker");
    sign("client", "/CN=vigil");
    write("passwords", "plant:secret of the plant\n");
    ASSERT_EQ(std::system(("mosquitto_passwd -U " + broker_.file("passwords") + " 2>/dev/null").c_str()), 0);
    ASSERT_TRUE(broker_.start());
  }
  void openssl(const std::string& arguments) {
    const std::string command = "cd " + broker_.file(".") + " && openssl " + arguments + " >/dev/null 2>&1";
    ASSERT_EQ(std::system(command.c_str()), 0) << command;
  }
  void make_authority(const std::string& name) {
    openssl("req -x509 -newkey rsa:2048 -nodes -days 2 -subj /CN=" + name + " -keyout " + name + ".key -out " + name +
            ".crt");
  }
  void sign(const std::string& name, const std::string& subject) {
    write("names", "subjectAltName=IP:127.0.0.1\n");
    openssl("req -newkey rsa:2048 -nodes -subj " + subject + " -keyout " + name + ".key -out " + name + ".csr");
    openssl("x509 -req -in " + name + ".csr -CA ca.crt -CAkey ca.key -CAcreateserial -days 2 -extfile names -out " +
            name + ".crt");
  }
  void write(const std::string& name, const std::string& text) { std::ofstream(broker_.file(name)) << text; }

  /// Whether a server with these credentials reaches the broker; what it says otherwise.
  std::string try_out(const Json& credentials, const std::string& host = "127.0.0.1") {
    write("who", credentials.dump());
    const api_test::TemporaryFolder folder;
    const api_test::ServerProcess server({"--db", folder.file("log.db"), "--no-demo", "--mqtt",
                                          "ssl://" + host + ":" + std::to_string(broker_.tls_port()), "--mqtt-topic",
                                          "plant/{run}/rows", "--mqtt-credentials", broker_.file("who")});
    const api_test::Client client(server.port());
    Json broker;
    eventually([&] {
      broker = client.get("/api/v1/ingest").json.at("broker");
      return broker.at("connected") == true || !broker.at("error").is_null();
    });
    return broker.at("connected") == true ? "connected" : broker.at("error").get<std::string>();
  }

  Mosquitto broker_{"allow_anonymous false\npassword_file {folder}/passwords\nrequire_certificate true\n", true};
};

TEST_F(TlsTest, OnlyWhoIsKnownAndKnowsTheBrokerGetsIn) {
  const Json right{{"user", "plant"},
                   {"password", "secret of the plant"},
                   {"ca", "ca.crt"},
                   {"certificate", "client.crt"},
                   {"key", "client.key"}};
  EXPECT_EQ(try_out(right), "connected");
  const auto with = [&](const char* name, const char* value) {
    Json changed = right;
    changed[name] = value;
    return changed;
  };
  EXPECT_NE(try_out(with("password", "wrong")), "connected");
  EXPECT_NE(try_out(with("ca", "other.crt")), "connected") << "a broker that another authority vouches for";
  EXPECT_NE(try_out(right, "127.0.0.2"), "connected") << "the same broker, but the certificate is 127.0.0.1's";
  Json nameless = right;
  nameless.erase("certificate");
  nameless.erase("key");
  EXPECT_NE(try_out(nameless), "connected");
}

}  // namespace
}  // namespace vigil::mqtt_test::tls_test
