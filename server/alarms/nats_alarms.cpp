// Alarms and states out of the server, to whoever listens to a subject at that moment.
#include <algorithm>

#include "server/crew/broker.hpp"
#include "server/plant/outside.hpp"

namespace vigil {
namespace {

class NatsAlarms : public AlarmSink {
 public:
  NatsAlarms(Broker& broker, std::string prefix) : broker_(broker), prefix_(std::move(prefix)) {}

  std::string name() const override { return "nats"; }
  bool send(const Announcement& announcement) override {
    if (announcement.text.empty()) return true;  // nothing is kept that could be forgotten
    std::string subject = prefix_ + "/" + announcement.topic;
    std::replace(subject.begin(), subject.end(), '/', '.');
    return broker_.publish(subject, announcement.text);
  }
  bool connected() const override { return broker_.connected(); }
  std::uint64_t connections() const override { return 1; }
  Json status() const override { return {{"connected", broker_.connected()}, {"prefix", prefix_}}; }

 private:
  Broker& broker_;
  const std::string prefix_;
};

}  // namespace

std::unique_ptr<AlarmSink> open_nats_alarms(Broker& broker, const std::string& prefix) {
  return std::make_unique<NatsAlarms>(broker, prefix);
}

}  // namespace vigil
