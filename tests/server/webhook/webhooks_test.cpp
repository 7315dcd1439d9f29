// Alarms to a receiver on a real socket: one that answers, one that is dead, one that comes back.
#include "server/webhook/webhooks.hpp"

#include <gtest/gtest.h>
#include <httplib.h>

#include <atomic>
#include <optional>

#include "engine/core/input_error.hpp"
#include "tests/server/api/fixture.hpp"

namespace vigil::webhooks_test {
namespace {

using api_test::eventually;

class Receiver {
 public:
  explicit Receiver(int port = 0) {
    server_.Post("/hook", [this](const httplib::Request& request, httplib::Response& response) {
      const std::lock_guard lock(mutex_);
      bodies_.push_back(Json::parse(request.body));
      response.status = status;
    });
    port_ = port == 0 ? server_.bind_to_any_port("127.0.0.1") : (server_.bind_to_port("127.0.0.1", port) ? port : -1);
    thread_ = std::thread([this] { server_.listen_after_bind(); });
    eventually([this] { return server_.is_running(); });
  }
  ~Receiver() {
    server_.stop();
    thread_.join();
  }
  int port() const { return port_; }
  std::vector<Json> alarms() {
    const std::lock_guard lock(mutex_);
    std::vector<Json> all;
    for (const Json& body : bodies_) {
      for (const Json& alarm : body.at("alarms")) all.push_back(alarm);
    }
    return all;
  }
  std::atomic<int> status{204};

 private:
  httplib::Server server_;
  std::mutex mutex_;
  std::vector<Json> bodies_;
  int port_ = 0;
  std::thread thread_;
};

Mark alarm(std::int64_t k) {
  Mark mark;
  mark.k = k;
  mark.type = MarkType::alarm;
  mark.edge = MarkEdge::begin;
  mark.lane = "a";
  return mark;
}

WebhookOptions quick() {
  WebhookOptions options;
  options.allow = {"127.0.0.1"};
  options.wait = std::chrono::milliseconds(5);
  options.longest_wait = std::chrono::milliseconds(20);
  options.queue = 8;
  return options;
}

struct Late {
  std::mutex mutex;
  std::vector<Mark> marks;
  Webhooks::Note take() {
    return [this](RunId, const Mark& mark) {
      const std::lock_guard lock(mutex);
      marks.push_back(mark);
    };
  }
  std::size_t count() {
    const std::lock_guard lock(mutex);
    return marks.size();
  }
};

TEST(Webhooks, AlarmsArriveInOrderAlsoAfterTheRun) {
  Receiver receiver;
  Late late;
  Webhooks hooks(quick(), late.take());
  hooks.open(7, {"127.0.0.1", receiver.port(), "/hook"});
  for (int k = 0; k < 5; ++k) hooks.send(7, alarm(k));
  hooks.close(7);
  ASSERT_TRUE(eventually([&] { return receiver.alarms().size() == 5; }));
  for (int k = 0; k < 5; ++k) EXPECT_EQ(receiver.alarms()[static_cast<std::size_t>(k)].at("k"), k);
  EXPECT_EQ(late.count(), 0u);
}

TEST(Webhooks, ADeadReceiverIsANoteAndOneThatComesBackAnother) {
  std::optional<Receiver> receiver(std::in_place);
  const int port = receiver->port();
  receiver.reset();
  Late late;
  Webhooks hooks(quick(), late.take());
  hooks.open(7, {"127.0.0.1", port, "/hook"});
  hooks.send(7, alarm(1));
  std::vector<Mark> notes;
  ASSERT_TRUE(eventually([&] {
    for (Mark& note : hooks.notes(7)) notes.push_back(std::move(note));
    return !notes.empty();
  }));
  EXPECT_EQ(notes[0].code, "webhook_failing");
  for (int k = 2; k < 40; ++k) hooks.send(7, alarm(k));
  receiver.emplace(port);
  ASSERT_EQ(receiver->port(), port);
  ASSERT_TRUE(eventually([&] {
    for (Mark& note : hooks.notes(7)) notes.push_back(std::move(note));
    return notes.size() == 2;
  }));
  EXPECT_EQ(notes[1].code, "webhook_answers");
  const auto arrived = receiver->alarms();
  EXPECT_EQ(arrived.back().at("k"), 39);
  EXPECT_LE(arrived.size(), 9u) << "the oldest were given up";
}

TEST(Webhooks, ARunThatIsOverGivesUp) {
  Receiver receiver;
  receiver.status = 500;
  Late late;
  Webhooks hooks(quick(), late.take());
  hooks.open(7, {"127.0.0.1", receiver.port(), "/hook"});
  hooks.send(7, alarm(1));
  hooks.close(7);
  ASSERT_TRUE(eventually([&] { return late.count() == 1; }));
  EXPECT_EQ(late.marks[0].k, 1);
  EXPECT_TRUE(hooks.notes(7).empty());
}

TEST(Webhooks, AddressesAreReadStrictly) {
  const std::vector<std::string> allowed = {"127.0.0.1", "receiver", "::1"};
  const WebhookUrl url = read_webhook("http://receiver:81/a?b=1", allowed);
  EXPECT_EQ(url.host, "receiver");
  EXPECT_EQ(url.port, 81);
  EXPECT_EQ(url.path, "/a?b=1");
  EXPECT_EQ(read_webhook("http://[::1]:9", allowed).host, "::1");
  EXPECT_EQ(read_webhook("http://127.0.0.1", allowed).port, 80);
  for (const Json& bad :
       {Json("https://receiver/"), Json("receiver"), Json("http://"), Json("http://other/"), Json("http://receiver:0/"),
        Json("http://receiver:99999/"), Json("http://receiver:x/"), Json("http://receiver@other/"),
        Json("http://other@receiver/"), Json("http://receiver/\r\nX: y"), Json("http://receiver.other/"),
        Json("http://RECEIVER#/"), Json(5), Json("")}) {
    EXPECT_THROW(read_webhook(bad, allowed), InputError) << bad;
  }
  EXPECT_THROW(read_webhook("http://receiver/", {}), InputError);
}

TEST(Webhooks, WithoutAllowedHostsNothingIsSent) {
  Late late;
  Webhooks hooks({}, late.take());
  hooks.send(1, alarm(1));
  EXPECT_TRUE(hooks.notes(1).empty());
}

class WebhookRun : public api_test::ApiTest {};

TEST_F(WebhookRun, AlarmsOfARunAreSent) {
  Receiver receiver;
  server_.reset();
  options_.runs.webhooks.allow = {"127.0.0.1"};
  begin();
  const std::string id = client_->start(
      {{"scenario", "replay-ubb"}, {"webhook", "http://127.0.0.1:" + std::to_string(receiver.port()) + "/hook"}});
  ASSERT_TRUE(client_->reaches(id, "finished"));
  const Json marks = client_->get("/api/v1/runs/" + id + "/marks?type=alarm").json.at("items");
  ASSERT_FALSE(marks.empty());
  EXPECT_TRUE(eventually([&] { return !receiver.alarms().empty(); }));
  EXPECT_EQ(receiver.alarms().front().at("type"), "alarm");
}

}  // namespace
}  // namespace vigil::webhooks_test
