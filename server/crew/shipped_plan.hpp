/// A campaign's plan as bytes: every point's document with its gains, and the trace. Shipped once to each worker.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "server/runs/campaign_runner.hpp"

namespace vigil {

/// Packed.
std::string ship(const CampaignPlan& plan);

/// The plan at its other end. Safe from any thread.
class ShippedPlan {
 public:
  /// Throws std::runtime_error where the bytes are damaged.
  explicit ShippedPlan(std::string_view bytes);
  /// As plain_trial() of the plan that was shipped. Throws also std::out_of_range: there is no such trial.
  TrialResult trial(std::int64_t index, const std::atomic<bool>& stop);
  /// A range's trials, each kept as small as the merge allows: designs once a point, sums of whole blocks. before:
  /// called with each index. Throws as trial().
  std::vector<TrialResult> range(std::int64_t first, std::int64_t count, const std::atomic<bool>& stop,
                                 const std::function<void(std::int64_t index)>& before);

 private:
  std::int64_t point_of(std::int64_t index) const { return index / runs_; }
  std::shared_ptr<const CampaignPlan> plan_of(std::int64_t point);

  std::int64_t runs_ = 1;
  std::uint64_t first_seed_ = 1;
  std::shared_ptr<const Trace> trace_;
  std::vector<std::string> points_;  ///< texts: parsed when their first trial comes
  std::mutex mutex_;
  std::list<std::pair<std::int64_t, std::shared_ptr<const CampaignPlan>>> parsed_;  ///< of one point each, newest first
};

}  // namespace vigil
