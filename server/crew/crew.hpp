/// Who makes a campaign's trials: threads of this process, or workers elsewhere. The results do not depend on it.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "server/runs/campaign_runner.hpp"

namespace vigil {

/// A process that offers itself.
struct CrewMember {
  std::string name;
  int threads = 0;
  std::optional<std::string> refused;  ///< why it takes no trial of this campaign, one sentence
};

Json to_json(const CrewMember& member);

class Crew {
 public:
  using Take = std::function<void(std::int64_t index, const TrialResult& trial)>;
  virtual ~Crew() = default;
  /// The trials from plan.first on; `take` is called in trial order, each index once, on the calling thread. Ends early
  /// when `stop` becomes true. Throws what a trial threw, and std::runtime_error where the crew can work no more.
  virtual void run(const CampaignPlan& plan, const std::atomic<bool>& stop, const Take& take) = 0;
  /// Who works, as far as it is worth saying. Safe from any thread.
  virtual std::vector<CrewMember> members() const { return {}; }
};

}  // namespace vigil
