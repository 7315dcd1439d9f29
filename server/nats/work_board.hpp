/// The campaigns that a worker hears of: which it works for, which it refuses and why.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "server/crew/shipped_plan.hpp"
#include "server/nats/connection.hpp"
#include "server/nats/notices.hpp"

namespace vigil {

/// Shared by the threads that work for it.
class OfferedCampaign {
 public:
  explicit OfferedCampaign(const CampaignNotice& notice) : id(notice.id), plan_bytes_(notice.plan_bytes) {}
  const std::string id;
  std::atomic<bool> over{false};  ///< nobody waits for its trials any more

  /// Fetched once. Null where it cannot be had at the moment.
  std::shared_ptr<ShippedPlan> plan(const NatsConnection& connection);

 private:
  std::string fetch(const NatsConnection& connection) const;

  const std::size_t plan_bytes_;
  std::mutex mutex_;
  std::shared_ptr<ShippedPlan> plan_;
};

/// Safe from any thread.
class WorkBoard {
 public:
  struct Offer {
    std::shared_ptr<OfferedCampaign> campaign;  ///< null: there is none
    std::string key;                            ///< of its streams
    bool alone = false;                         ///< no other campaign waits for workers
  };

  WorkBoard(const NatsConnection& connection, CrewMember self, Fingerprint fingerprint);
  /// The next in turn after the one called `last`; waits a moment where there is none.
  Offer pick(const std::string& last);
  /// Where a campaign's results go now; empty: it is over.
  std::string key_of(const std::string& id) const;
  /// Tells all campaigns that we are here, and forgets those that are not.
  void tick();
  /// Everything is over.
  void close();

 private:
  using Clock = std::chrono::steady_clock;
  struct Known {
    std::shared_ptr<OfferedCampaign> campaign;
    std::string key;
    std::optional<std::string> refused;
    Clock::time_point heard{};
  };
  void hear(const natsMsg* message);
  Known meet(const CampaignNotice& notice) const;
  CrewMember member(const Known& known) const;

  const NatsConnection& connection_;
  const CrewMember self_;
  const Fingerprint fingerprint_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::map<std::string, Known> known_;
  bool closed_ = false, was_connected_ = false;
  NatsListener listener_;
};

}  // namespace vigil
