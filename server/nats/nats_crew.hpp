/// A campaign's trials by workers that the broker reaches. Used by one thread, but for members().
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "server/nats/connection.hpp"
#include "server/nats/muster.hpp"

namespace vigil {

class NatsCrew final : public Crew {
 public:
  NatsCrew(std::shared_ptr<const NatsConnection> connection, std::string owner);
  void run(const CampaignPlan& plan, const std::atomic<bool>& stop, const Take& take) override;
  std::vector<CrewMember> members() const override;

 private:
  std::shared_ptr<const NatsConnection> connection_;
  std::string owner_;
  Muster muster_;
};

}  // namespace vigil
