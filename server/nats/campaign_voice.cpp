#include "server/nats/campaign_voice.hpp"

#include <algorithm>
#include <charconv>

namespace vigil {
namespace {

constexpr std::size_t kLargestPart = 512 * 1024;  // bytes of the plan that an answer carries

}  // namespace

CampaignVoice::CampaignVoice(const NatsConnection& connection, Muster& muster, CampaignNotice notice, std::string plan)
    : connection_(connection),
      muster_(muster),
      plan_(std::move(plan)),
      notice_(std::move(notice)),
      plan_listener_(connection, plan_subject(notice_.id), [this](natsMsg* request) { answer(request); }),
      crew_listener_(connection, crew_subject(notice_.id), [this](natsMsg* message) { hear(message); }),
      speaker_([this] { speak(); }) {}

CampaignVoice::~CampaignVoice() {
  {
    const std::lock_guard lock(mutex_);
    notice_.over = true;
  }
  changed_.notify_all();
  speaker_.join();
}

void CampaignVoice::set_key(const std::string& key) {
  {
    const std::lock_guard lock(mutex_);
    notice_.key = key;
  }
  changed_.notify_all();
}

void CampaignVoice::speak() {
  std::unique_lock lock(mutex_);
  for (;;) {
    const CampaignNotice notice = notice_;
    lock.unlock();
    if (!notice.key.empty()) connection_.publish(kCampaignSubject, to_text(notice));
    lock.lock();
    if (notice.over) return;
    changed_.wait_for(lock, kNoticeEvery, [&] { return notice_.over || notice_.key != notice.key; });
  }
}

/// A request is a place in the plan, the answer its bytes from there on.
void CampaignVoice::answer(natsMsg* request) const {
  const char* to = natsMsg_GetReply(request);
  const std::string_view text = text_of(request);
  std::size_t from = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), from);
  if (to == nullptr || error != std::errc() || from >= plan_.size()) return;
  connection_.publish(to, std::string_view(plan_).substr(from, std::min(kLargestPart, connection_.room())));
}

void CampaignVoice::hear(natsMsg* message) {
  const auto member = crew_member(text_of(message));
  if (!member || !muster_.note(*member)) return;
  connection_.say("worker " + member->name + " takes no trial of this campaign: " + *member->refused);
}

}  // namespace vigil
