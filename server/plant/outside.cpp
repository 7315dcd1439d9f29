#include "server/plant/outside.hpp"

#include <utility>

namespace vigil {

Outside::Outside(OutsideOptions options, const LogReader& reader) : options_(std::move(options)) {
  std::vector<std::unique_ptr<AlarmSink>> sinks;
  if (options_.mqtt) {
    check_mqtt(*options_.mqtt);
    sinks.push_back(open_mqtt_alarms(*options_.mqtt));
  }
  if (options_.nats != nullptr) sinks.push_back(open_nats_alarms(*options_.nats, options_.prefix));
  AnnouncerOptions announcing;
  announcing.logged = [&reader](RunId run) {
    const auto row = reader.run(run);
    return row ? std::optional(row->state) : std::nullopt;
  };
  announcer_ = std::make_unique<Announcer>(std::move(sinks), std::move(announcing));
}

Outside::~Outside() { stop(); }

void Outside::listen(const RunManager& runs) {
  if (!listens()) return;
  const std::lock_guard lock(mutex_);
  inbox_ = std::make_unique<PlantInbox>(
      options_.mqtt->topics, [&runs](const std::string& run) { return runs.fed(run); }, options_.mqtt->inbox);
  link_ = open_plant_link(*options_.mqtt, *inbox_);
}

void Outside::stop() {
  const std::lock_guard lock(mutex_);
  if (inbox_) inbox_->stop();
  link_.reset();
}

Json Outside::plant() const {
  const std::lock_guard lock(mutex_);
  if (!inbox_ || !link_) return nullptr;
  Json status = inbox_->status();
  status["broker"] = link_->status();
  return status;
}

}  // namespace vigil
