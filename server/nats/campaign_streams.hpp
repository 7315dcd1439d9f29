/// The two streams of one campaign: jobs out (kept in files), results back (kept in memory); gone with the campaign.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "server/crew/job.hpp"
#include "server/nats/connection.hpp"

namespace vigil {

/// After so long without a sign of life from its worker a job is handed out again.
inline constexpr auto kAckWait = std::chrono::seconds(5);
/// A job is handed out so often in all.
inline constexpr int kMostDeliveries = 6;

/// Used by one thread.
class CampaignStreams {
 public:
  CampaignStreams(const NatsConnection& connection, std::string id);
  ~CampaignStreams();  ///< deletes them, as far as the broker is there
  CampaignStreams(const CampaignStreams&) = delete;
  CampaignStreams& operator=(const CampaignStreams&) = delete;

  /// Of the streams that are there now; empty before the first make().
  const std::string& key() const { return key_; }
  /// New and empty ones, under a key of their own; those of this campaign that were there before are deleted. False
  /// where the broker does not answer; it is to be tried again then. Throws std::runtime_error where the broker cannot
  /// keep streams.
  bool make();
  /// False where not all of them are known to be stored.
  bool publish(const std::vector<TrialJob>& jobs);
  /// Pieces of results, acknowledged; waits up to `patience` for the first.
  std::vector<std::string> collect(std::chrono::milliseconds patience);

  enum class Health {
    unknown,    ///< the broker does not answer
    lost,       ///< a stream or its consumer is not there
    busy,       ///< jobs wait or are being worked on, or results are on their way
    idle,       ///< neither a job nor a result is left
    exhausted,  ///< all jobs that are left were handed out as often as may be
  };
  Health health();
  /// The jobs that are left, taken out.
  std::vector<TrialJob> take_exhausted();

 private:
  bool add_stream(const std::string& name, const std::string& subject, jsStorageType storage);
  bool add_consumer(const std::string& stream, const char* name, int deliveries);
  void sweep() const;

  const NatsConnection& connection_;
  std::string id_, key_;
  NatsOwned<natsSubscription> results_;
};

}  // namespace vigil
