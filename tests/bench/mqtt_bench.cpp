/// Readings a second from a real broker at QoS 1 into a run, and a bare subscriber that only acknowledges the same
/// messages; then the same over a restart of the broker, with what was lost.
/// mqtt_bench [readings] [repeats]
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>

#include "server/api/server.hpp"
#include "tests/server/mqtt/mosquitto.hpp"
#include "tests/server/mqtt/plain_client.hpp"

namespace vigil::bench {
namespace {

using api_test::eventually;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

/// Messages of eight nodes with two channels each, as the preset `consensus` has them: one value a message, or the two
/// of a node together.
struct Messages {
  bool whole = false;
  std::vector<std::pair<std::string, std::string>> all;

  /// `root`: the topics' first level.
  Messages(bool whole_rows, std::int64_t readings, const std::string& root, const std::string& run)
      : whole(whole_rows) {
    for (std::int64_t k = 0; static_cast<std::int64_t>(all.size()) * (whole ? 2 : 1) < readings; ++k) {
      for (int node = 1; node <= 8; ++node) {
        const std::string topic = root + "/" + run + "/" + std::to_string(node);
        const std::string tick = "{\"k\":" + std::to_string(k);
        if (whole) {
          all.emplace_back(topic, tick + ",\"p\":501.25,\"q\":80.125}");
        } else {
          all.emplace_back(topic + "/p", tick + ",\"value\":501.25}");
          all.emplace_back(topic + "/q", tick + ",\"value\":80.125}");
        }
      }
    }
  }
  double readings() const { return static_cast<double>(all.size()) * (whole ? 2 : 1); }
};

/// Publishes all, over losses of the connection.
void publish(const mqtt_test::Mosquitto& broker, const Messages& messages) {
  mqtt_test::PlainClient client;
  const auto come_back = [&] { eventually([&] { return client.connect(broker.port(), "bench") && client.resend(); }); };
  come_back();
  for (const auto& [topic, payload] : messages.all) {
    if (!client.publish(topic, payload)) come_back();
  }
  while (!client.settle()) come_back();
}

double yardstick(mqtt_test::Mosquitto& broker, const Messages& messages) {
  mqtt_test::PlainClient subscriber;
  if (!subscriber.connect(broker.port(), "yardstick") || !subscriber.subscribe("bare/#")) std::exit(1);
  const auto begin = Clock::now();
  std::thread publisher([&] { publish(broker, messages); });
  for (std::size_t got = 0; got < messages.all.size(); ++got) {
    if (!subscriber.next()) std::exit(1);
  }
  publisher.join();
  return messages.readings() / seconds_since(begin);
}

class Ours {
 public:
  explicit Ours(const mqtt_test::Mosquitto& broker) {
    ServerOptions options;
    options.front.port = 0;
    options.demo = false;
    options.db = folder_.file("log.db");
    options.mqtt.emplace();
    options.mqtt->url = broker.url();
    options.mqtt->client = "bench-vigil";
    options.mqtt->prefix = "vigil/bench";
    for (const char* topic : {"plant/{run}/{node}", "plant/{run}/{node}/{channel}"})
      options.mqtt->topics.emplace_back(topic);
    outside_.emplace(OutsideOptions{options.mqtt, nullptr, ""}, reader());
    runs_.emplace(*log_, *reader_, hub_, ManagerOptions{});
    outside_->listen(*runs_);
    eventually([&] { return outside_->plant().at("broker").at("connected") == true; });
  }
  ~Ours() {
    outside_->stop();
    runs_->stop();
  }

  /// A run without an end that is fed; the tick that the readings reach must be the last one.
  std::shared_ptr<LiveRun> start(const std::string& name) {
    RunOrder order;
    order.scenario = Scenario::preset("consensus")
                         .patched({{"time", {{"steps", nullptr}}},
                                   {"initial", {{"truth", {0, 0, 0}}}},
                                   {"log", {{"signals", {"truth.*"}}}}});
    order.feed = std::make_shared<IngestFeed>(
        order.scenario, read_ingest({{"ingest", {{"deadline", 3600}, {"mqtt", {{"name", name}}}}}}));
    return runs_->find(runs_->create(std::move(order)).id);
  }
  Json link() const { return outside_->plant(); }

 private:
  const LogReader& reader() {
    log_.emplace(folder_.file("log.db"));
    reader_.emplace(folder_.file("log.db"));
    return *reader_;
  }
  api_test::TemporaryFolder folder_;
  std::optional<LogWriter> log_;
  std::optional<LogReader> reader_;
  Hub hub_;
  std::optional<Outside> outside_;
  std::optional<RunManager> runs_;
};

struct Result {
  double rate = 0;
  std::int64_t accepted = 0, duplicate = 0;
};

/// Until every reading was taken, or none has come for ten seconds.
Result ours(Ours& server, mqtt_test::Mosquitto& broker, const Messages& messages, const std::string& name,
            bool restart) {
  const auto run = server.start(name);
  const auto begin = Clock::now();
  std::thread publisher([&] { publish(broker, messages); });
  const auto wanted = static_cast<std::int64_t>(messages.all.size());
  Result result;
  auto newest = begin;
  bool restarted = !restart;
  while (result.accepted < wanted && seconds_since(newest) < 10) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    const Json status = run->order().feed->status();
    if (status.at("accepted") > result.accepted) newest = Clock::now();
    result.accepted = status.at("accepted");
    result.duplicate = status.at("duplicate").get<std::int64_t>() + status.at("late").get<std::int64_t>();
    if (restarted || result.accepted < wanted / 2) continue;
    broker.end(SIGTERM);
    broker.start();
    restarted = true;
  }
  result.rate = messages.readings() / std::chrono::duration<double>(newest - begin).count();
  publisher.join();
  run->stop("stopped");
  return result;
}

int measure(std::int64_t readings, int repeats) {
  if (const std::string reason = mqtt_test::why_not(); !reason.empty()) {
    std::printf("not measured: %s\n", reason.c_str());
    return 0;
  }
  mqtt_test::Mosquitto broker;
  if (!broker.start()) return 1;
  Ours server(broker);
  int number = 0;
  for (const bool whole : {false, true}) {
    for (int i = 0; i < repeats; ++i) {
      const std::string name = "bench" + std::to_string(++number);
      const Messages messages(whole, readings, "plant", name);
      // On topics that the server does not hear: the broker would send them twice.
      const double bare = yardstick(broker, Messages(whole, readings, "bare", name));
      const Result got = ours(server, broker, messages, name, false);
      std::printf("%s a message: %.0f readings/s, a bare subscriber %.0f, ratio %.2f; lost %lld\n",
                  whole ? "a node's two readings" : "one reading", got.rate, bare, got.rate / bare,
                  static_cast<long long>(static_cast<std::int64_t>(messages.all.size()) - got.accepted));
    }
  }
  const Messages messages(false, readings, "plant", "restart");
  const Result got = ours(server, broker, messages, "restart", true);
  std::printf("over a restart of the broker: %lld of %zu readings taken, %lld came twice, %.0f readings/s\n",
              static_cast<long long>(got.accepted), messages.all.size(), static_cast<long long>(got.duplicate),
              got.rate);
  return got.accepted == static_cast<std::int64_t>(messages.all.size()) ? 0 : 1;
}

}  // namespace
}  // namespace vigil::bench

int main(int argc, char** argv) {
  return vigil::bench::measure(argc > 1 ? std::atoll(argv[1]) : 200'000, argc > 2 ? std::atoi(argv[2]) : 3);
}
