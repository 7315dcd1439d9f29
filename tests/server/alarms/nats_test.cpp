// Alarms and states as a listener of a real NATS broker hears them.
#include <arpa/inet.h>
#include <sys/socket.h>

#include "tests/server/nats/processes.hpp"

namespace vigil::api_test::nats_test {
namespace {

/// Hears a subject over a bare socket.
class Listener {
 public:
  Listener(int port, const std::string& subject) {
    timeval patience{0, 50'000};
    setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    say("CONNECT {\"verbose\":false}\r\nSUB " + subject + " 1\r\nPING\r\n");
    EXPECT_TRUE(eventually([this] { return heard().find("PONG") != std::string::npos; }));
  }
  ~Listener() { close(socket_); }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;
  const std::string& heard() {
    char part[65536];
    for (ssize_t n = recv(socket_, part, sizeof part, 0); n > 0; n = recv(socket_, part, sizeof part, 0))
      heard_.append(part, static_cast<std::size_t>(n));
    return heard_;
  }

 private:
  void say(const std::string& text) {
    EXPECT_EQ(send(socket_, text.data(), text.size(), MSG_NOSIGNAL), static_cast<ssize_t>(text.size()));
  }
  int socket_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  std::string heard_;
};

class NatsAlarmsTest : public ApiTest {
 protected:
  void SetUp() override {
    if (const std::string reason = BrokerProcess::missing(); !reason.empty()) GTEST_SKIP() << reason;
    broker_.emplace();
    options_.nats.url = broker_->url();
    options_.nats_prefix = "vigil/test";
    begin();
  }
  std::optional<BrokerProcess> broker_;
};

TEST_F(NatsAlarmsTest, AlarmsAndStatesAreSubjects) {
  Listener listener(std::stoi(broker_->url().substr(broker_->url().rfind(':') + 1)), "vigil.test.>");
  ASSERT_TRUE(eventually(
      [this] { return client_->get("/api/v1/server").json.at("alarms").at("nats").at("connected") == true; }));
  const std::string id = client_->start({{"scenario", "replay-ubb"}});
  ASSERT_TRUE(client_->reaches(id, "finished"));
  EXPECT_TRUE(eventually([&] {
    const std::string& heard = listener.heard();
    return heard.find("MSG vigil.test.runs." + id + ".alarms") != std::string::npos &&
           heard.find("\"state\":\"finished\"") != std::string::npos;
  })) << listener.heard().substr(0, 2000);
}

}  // namespace
}  // namespace vigil::api_test::nats_test
