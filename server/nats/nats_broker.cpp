// NATS behind the server's interface.
#include "server/nats/nats_crew.hpp"

namespace vigil {
namespace {

class NatsBroker final : public Broker {
 public:
  explicit NatsBroker(const NatsOptions& options) : connection_(std::make_shared<NatsConnection>(options)) {}
  bool connected() const override { return connection_->connected(); }
  bool publish(const std::string& subject, std::string_view data) override {
    return connection_->publish(subject, data);
  }
  std::unique_ptr<Crew> crew(const std::string& owner) override {
    return std::make_unique<NatsCrew>(connection_, owner);
  }

 private:
  std::shared_ptr<const NatsConnection> connection_;
};

}  // namespace

std::unique_ptr<Broker> connect_nats(const NatsOptions& options) { return std::make_unique<NatsBroker>(options); }

}  // namespace vigil
