/// The crew that needs nothing else: threads of this process.
#pragma once

#include "server/crew/crew.hpp"

namespace vigil {

/// As many as the plan says.
class ThreadCrew final : public Crew {
 public:
  void run(const CampaignPlan& plan, const std::atomic<bool>& stop, const Take& take) override;
};

}  // namespace vigil
