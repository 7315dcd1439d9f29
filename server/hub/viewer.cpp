#include "server/hub/viewer.hpp"

#include <algorithm>
#include <charconv>

namespace vigil {
namespace {

/// Enough to fill a socket's buffer in one call; little enough for a stalled viewer to hold.
constexpr std::size_t kBatchBytes = 32 * 1024;
constexpr std::size_t kBatchPackets = 16;

struct EventId {
  std::string_view epoch;
  std::int64_t k = -1;
};

/// "epoch.k"; an empty epoch where it is not that.
EventId parse_event_id(std::string_view text) {
  const auto dot = text.rfind('.');
  if (dot == std::string_view::npos) return {};
  EventId id{text.substr(0, dot), -1};
  const auto [end, error] = std::from_chars(text.data() + dot + 1, text.data() + text.size(), id.k);
  if (error != std::errc() || end != text.data() + text.size() || id.k < -1) return {};
  return id;
}

}  // namespace

Viewer::Viewer(std::shared_ptr<Feed> feed, std::size_t topic) : feed_(std::move(feed)), topic_(topic) {}

void Viewer::begin(std::string_view last_event_id) {
  if (last_event_id.empty()) {
    start_fresh();
    return;
  }
  const EventId id = parse_event_id(last_event_id);
  if (id.epoch != feed_->epoch()) {
    start_with_gap(id.k, "restart", false);
  } else if (!resume(id.k)) {
    start_with_gap(id.k, "ring", true);
  }
}

/// A new viewer gets the newest tick at once, so that a paused run shows its state too.
void Viewer::start_fresh() {
  position_ = feed_->head().value_or(feed_->end());
  marks_at_ = position_;
  last_tick_ = feed_->tick_before_head();
  hello(false, last_tick_);
}

bool Viewer::resume(std::int64_t k) {
  const auto start = feed_->position_after(topic_, k);
  if (!start) return false;
  position_ = marks_at_ = *start;
  last_tick_ = k;
  hello(true, k);
  return true;
}

void Viewer::start_with_gap(std::int64_t after, std::string_view reason, bool known) {
  position_ = feed_->head().value_or(feed_->end());
  const std::int64_t newest = feed_->tick_before_head();
  if (after > newest) after = -1;  // ticks of another life of the server: all of this one's are news
  // Within one epoch the viewer's marks up to `after` are known to have arrived; of another life's nothing is. What the
  // global feed says is also in the list of runs, where its gap points: no need to tell a stranger all of it.
  const std::uint64_t marks = known ? feed_->mark_after_tick(after) : feed_->global() ? position_ : feed_->first_mark();
  marks_at_ = std::min(position_, marks);
  last_tick_ = newest;
  hello(false, newest);
  if (after < newest) special_.push_back(gap(after + 1, newest, reason, marks_at_));
}

void Viewer::hello(bool resumed, std::int64_t from) {
  Json data;
  data["epoch"] = feed_->epoch();
  if (!feed_->global()) {
    data["run"] = std::to_string(feed_->run());
    data["topic"] = feed_->topics()[topic_].name;
  }
  data["resumed"] = resumed;
  data["from"] = from;
  data["head"] = feed_->head_tick();
  if (!feed_->global()) {
    data["dt"] = feed_->dt();
    data["signals"] = feed_->topics()[topic_].signals;
  }
  const std::string text = "retry: 1000\nevent: hello\ndata: " + dump(data) + "\n\n";
  special_.push_back(std::make_shared<const std::string>(as_chunk(text)));
}

Packet Viewer::gap(std::int64_t from, std::int64_t to, std::string_view reason, std::uint64_t marks_since) const {
  const std::string range = "?from=" + std::to_string(from) + "&to=" + std::to_string(to);
  const std::string base = "/api/v1/runs/" + std::to_string(feed_->run());
  Json data;
  data["from"] = from;
  data["to"] = to;
  data["reason"] = reason;
  data["fill"] = feed_->global() ? "/api/v1/runs" : base + "/samples" + range;
  // Marks are sent again after the gap; only what the hub itself no longer has must be fetched.
  if (!feed_->global() && feed_->marks_lost_before() > marks_since) data["marks"] = base + "/marks" + range;
  return encode_event("gap", dump(data));
}

/// The viewer fell out of the ring: on to the newest tick, then the marks of what was jumped over.
Packet Viewer::jump() {
  const std::uint64_t lost_from = position_;
  marks_at_ = std::min(marks_at_, lost_from);
  const bool marks_lost = feed_->marks_lost_before() > marks_at_;
  position_ = std::max(feed_->head().value_or(feed_->end()), feed_->low(topic_));
  const std::int64_t to = feed_->global() ? feed_->marks_lost_tick() : feed_->tick_before_head();
  const std::int64_t from = last_tick_ + 1;
  if (to < from || (feed_->global() && !marks_lost)) return nullptr;
  last_tick_ = to;
  return gap(from, to, "slow", marks_at_);
}

Packet Viewer::next() {
  if (!special_.empty()) {
    Packet packet = std::move(special_.front());
    special_.pop_front();
    return packet;
  }
  if (ended_) return nullptr;
  if (position_ < feed_->low(topic_)) {
    if (Packet packet = jump()) return packet;
  }
  if (marks_at_ < position_) {
    const Feed::KeptMark* mark = feed_->mark_from(marks_at_);
    if (mark && mark->sequence < position_) {
      marks_at_ = mark->sequence + 1;
      return mark->text;
    }
  }
  if (position_ >= feed_->end()) return nullptr;
  Packet packet = feed_->packet(topic_, position_);
  const Feed::Item& item = feed_->item(position_);
  if (item.kind == Feed::Kind::frame || feed_->global()) last_tick_ = item.k;
  ended_ = item.kind == Feed::Kind::end;
  marks_at_ = ++position_;
  return packet;
}

int Viewer::gather(iovec* parts, int count) {
  const auto limit = std::min<std::size_t>(static_cast<std::size_t>(count), kBatchPackets);
  std::size_t bytes = 0;
  for (const Packet& packet : outgoing_) bytes += packet->size();
  while (outgoing_.size() < limit && bytes < kBatchBytes) {
    Packet packet = next();
    if (!packet) break;
    bytes += packet->size();
    outgoing_.push_back(std::move(packet));
  }
  int n = 0;
  for (const Packet& packet : outgoing_) {
    if (n == count) break;
    const std::size_t skip = n == 0 ? offset_ : 0;
    parts[n++] = {const_cast<char*>(packet->data()) + skip, packet->size() - skip};
  }
  return n;
}

void Viewer::sent(std::size_t bytes) {
  while (bytes > 0 && !outgoing_.empty()) {
    const std::size_t left = outgoing_.front()->size() - offset_;
    if (bytes < left) {
      offset_ += bytes;
      return;
    }
    bytes -= left;
    offset_ = 0;
    outgoing_.pop_front();
  }
}

void Viewer::finish() {
  if (ended_) return;
  ended_ = true;
  special_.clear();
  outgoing_.push_back(std::make_shared<const std::string>(kLastChunk));
}

void Viewer::ping(const Packet& packet) {
  if (outgoing_.empty() && special_.empty() && !ended_) special_.push_back(packet);
}

}  // namespace vigil
