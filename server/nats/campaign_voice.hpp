/// A campaign's side of the notices: offers its work again and again, hands out its plan, hears who is there.
#pragma once

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include "server/nats/connection.hpp"
#include "server/nats/muster.hpp"
#include "server/nats/notices.hpp"

namespace vigil {

class CampaignVoice {
 public:
  /// notice: without its key. plan: packed. All outlive the voice.
  CampaignVoice(const NatsConnection& connection, Muster& muster, CampaignNotice notice, std::string plan);
  ~CampaignVoice();  ///< says that it is over
  CampaignVoice(const CampaignVoice&) = delete;
  CampaignVoice& operator=(const CampaignVoice&) = delete;
  /// From now on the work is in these streams.
  void set_key(const std::string& key);

 private:
  void speak();
  void answer(natsMsg* request) const;
  void hear(natsMsg* message);

  const NatsConnection& connection_;
  Muster& muster_;
  const std::string plan_;
  std::mutex mutex_;
  std::condition_variable changed_;
  CampaignNotice notice_;
  NatsListener plan_listener_, crew_listener_;
  std::thread speaker_;
};

}  // namespace vigil
