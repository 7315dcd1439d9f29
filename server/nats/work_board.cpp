#include "server/nats/work_board.hpp"

#include <algorithm>

namespace vigil {
namespace {

using namespace std::chrono_literals;

constexpr auto kMoment = 200ms;
constexpr std::int64_t kAnswer = 3000;  // ms to wait for a part of a plan
constexpr std::size_t kMostPlan = std::size_t{1} << 32;

}  // namespace

std::string OfferedCampaign::fetch(const NatsConnection& connection) const {
  std::string bytes;
  const std::string subject = plan_subject(id);
  while (bytes.size() < plan_bytes_ && plan_bytes_ <= kMostPlan && !over) {
    const std::string place = std::to_string(bytes.size());
    natsMsg* raw = nullptr;
    const auto size = static_cast<int>(place.size());
    if (natsConnection_Request(&raw, connection.get(), subject.c_str(), place.data(), size, kAnswer) != NATS_OK)
      return {};
    const NatsOwned<natsMsg> answer(raw);
    if (text_of(raw).empty()) return {};
    bytes += text_of(raw);
  }
  return bytes;
}

std::shared_ptr<ShippedPlan> OfferedCampaign::plan(const NatsConnection& connection) {
  const std::lock_guard lock(mutex_);
  if (plan_) return plan_;
  const std::string bytes = fetch(connection);
  if (!bytes.empty() && bytes.size() == plan_bytes_) plan_ = std::make_shared<ShippedPlan>(bytes);
  return plan_;
}

WorkBoard::WorkBoard(const NatsConnection& connection, CrewMember self, Fingerprint fingerprint)
    : connection_(connection),
      self_(std::move(self)),
      fingerprint_(std::move(fingerprint)),
      listener_(connection, kCampaignSubject, [this](const natsMsg* message) { hear(message); }) {}

WorkBoard::Known WorkBoard::meet(const CampaignNotice& notice) const {
  Known known;
  known.campaign = std::make_shared<OfferedCampaign>(notice);
  known.refused = difference(notice.fingerprint, fingerprint_);
  const std::string name = "campaign " + notice.id + " (" + notice.what + ")";
  connection_.say(known.refused ? name + " is refused: this worker differs, " + *known.refused : "works for " + name);
  return known;
}

CrewMember WorkBoard::member(const Known& known) const {
  CrewMember self = self_;
  self.refused = known.refused;
  return self;
}

void WorkBoard::hear(const natsMsg* message) {
  const auto notice = campaign_notice(text_of(message));
  if (!notice) return;
  const std::lock_guard lock(mutex_);
  if (closed_) return;
  auto place = known_.find(notice->id);
  if (notice->over) {
    if (place == known_.end()) return;
    place->second.campaign->over = true;
    known_.erase(place);
    return;
  }
  if (place == known_.end()) {
    place = known_.emplace(notice->id, meet(*notice)).first;
    // At once: a campaign hands out as much as the threads it knows of can make.
    connection_.publish(crew_subject(notice->id), to_text(member(place->second)));
  }
  place->second.key = notice->key;
  place->second.heard = Clock::now();
  changed_.notify_all();
}

WorkBoard::Offer WorkBoard::pick(const std::string& last) {
  std::unique_lock lock(mutex_);
  const auto fits = [](const auto& one) { return !one.second.refused; };
  const auto any = [&] { return closed_ || std::any_of(known_.begin(), known_.end(), fits); };
  if (!changed_.wait_for(lock, kMoment, any) || closed_) return {};
  auto place = std::find_if(known_.upper_bound(last), known_.end(), fits);
  if (place == known_.end()) place = std::find_if(known_.begin(), known_.end(), fits);
  return {place->second.campaign, place->second.key, std::count_if(known_.begin(), known_.end(), fits) == 1};
}

std::string WorkBoard::key_of(const std::string& id) const {
  const std::lock_guard lock(mutex_);
  const auto place = known_.find(id);
  return place == known_.end() ? std::string() : place->second.key;
}

void WorkBoard::tick() {
  const bool connected = connection_.connected();
  std::vector<std::pair<std::string, CrewMember>> words;
  {
    const std::lock_guard lock(mutex_);
    const auto now = Clock::now();
    for (auto& [id, known] : known_) {
      if (!connected || !was_connected_) known.heard = now;  // silence counts only while somebody could be heard
      words.emplace_back(crew_subject(id), member(known));
    }
    was_connected_ = connected;
    std::erase_if(known_, [&](const auto& one) {
      const bool gone = now - one.second.heard > kNoticePatience;
      if (gone) one.second.campaign->over = true;
      return gone;
    });
  }
  for (const auto& [subject, self] : words) connection_.publish(subject, to_text(self));
}

void WorkBoard::close() {
  const std::lock_guard lock(mutex_);
  closed_ = true;
  for (auto& [id, known] : known_) known.campaign->over = true;
  known_.clear();
  changed_.notify_all();
}

}  // namespace vigil
