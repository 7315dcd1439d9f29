/// What connects a server's runs with the world outside: topics that feed them, sinks that hear of their alarms.
#pragma once

#include <memory>
#include <mutex>
#include <optional>

#include "db/reader.hpp"
#include "server/alarms/announcer.hpp"
#include "server/plant/mqtt.hpp"
#include "server/runs/manager.hpp"

namespace vigil {

class Broker;

struct OutsideOptions {
  std::optional<MqttOptions> mqtt;
  Broker* nats = nullptr;  ///< alarms go there, too; outlives this
  std::string prefix;      ///< of NATS' subjects, without the last dot
};

class Outside {
 public:
  /// `reader` outlives it. Throws std::runtime_error where the options cannot be used. Returns before there is a
  /// broker.
  Outside(OutsideOptions options, const LogReader& reader);
  ~Outside();

  Announcer& announcer() { return *announcer_; }
  /// From here on topics feed runs, until stop(); `runs` outlives that. Nothing where no topic was given.
  void listen(const RunManager& runs);
  void stop();
  /// Whether a run may be fed by topics.
  bool listens() const { return options_.mqtt && !options_.mqtt->topics.empty(); }
  /// Of GET /ingest: the link's and the inbox's; null where it does not listen.
  Json plant() const;
  /// {"mqtt":…,"nats":…}: the sinks'; what there is not is left out.
  Json alarms() const { return announcer_->status(); }

 private:
  const OutsideOptions options_;
  std::unique_ptr<Announcer> announcer_;
  mutable std::mutex mutex_;  ///< around the two below: they come and go while others ask
  std::unique_ptr<PlantInbox> inbox_;
  std::unique_ptr<PlantLink> link_;
};

/// Alarms and states as subjects of NATS, `<prefix>.runs.<id>.alarms` and so on; nothing is kept there.
std::unique_ptr<AlarmSink> open_nats_alarms(Broker& broker, const std::string& prefix);

}  // namespace vigil
