#include "server/hub/feed.hpp"

#include <algorithm>

namespace vigil {
namespace {

std::size_t frame_cap(const HubOptions& options, int signals) {
  const std::size_t bytes = sizeof(double) * static_cast<std::size_t>(std::max(signals, 1));
  return std::clamp<std::size_t>(options.ring_bytes / bytes, 4, std::max<std::size_t>(options.ring_frames, 4));
}

std::chrono::nanoseconds frame_interval(const HubOptions& options) {
  return std::chrono::nanoseconds(static_cast<std::int64_t>(1e9 / std::max(options.frames_per_second, 1e-3)));
}

}  // namespace

void Alarm::ring() {
  if (rung_.exchange(true)) return;
  const std::lock_guard lock(mutex_);
  if (waker_) waker_();
}

void Alarm::set(std::function<void()> waker) {
  const std::lock_guard lock(mutex_);
  waker_ = std::move(waker);
  rung_.store(false);
}

Feed::Feed(FeedContext context, std::int64_t run, std::string epoch, int signals, std::vector<HubTopic> topics,
           double dt)
    : context_(std::move(context)),
      run_(run),
      epoch_(std::move(epoch)),
      dt_(dt),
      topics_(std::move(topics)),
      frame_cap_(frame_cap(context_.options, signals)),
      interval_(frame_interval(context_.options)),
      rings_(topics_.size()) {
  next_ping = context_.options.clock() + context_.options.ping;
}

Feed::Item Feed::fresh_item() {
  Item item;
  if (!pool_.empty()) {
    item.values = std::move(pool_.back());
    pool_.pop_back();
  }
  return item;
}

void Feed::frame(const Frame& frame) {
  const auto now = context_.options.clock();
  {
    const std::lock_guard lock(mutex_);
    if (closed_) return;
    ++ticks_;
    pending_.k = frame.k;
    pending_.t = frame.t;
    pending_.values.assign(frame.values.begin(), frame.values.end());
    has_pending_ = true;
    if (now < due_) return;  // the reader comes back for it within the interval
    due_ = std::max(due_, now - interval_) + interval_;
    flush_pending();
  }
  context_.alarm->ring();
}

void Feed::flush_pending() {
  pending_.n = ticks_;
  ticks_ = 0;
  has_pending_ = false;
  push(std::exchange(pending_, fresh_item()));
}

void Feed::push(Item item) {
  if (item.kind == Kind::frame) ++inbox_frames_;
  inbox_.push_back(std::move(item));
  if (inbox_frames_ > frame_cap_) shed_inbox();
}

/// Only when nobody reads (or the reader hangs): the oldest frame goes, and the next one says that it stands for both.
void Feed::shed_inbox() {
  const auto is_frame = [](const Item& item) { return item.kind == Kind::frame; };
  const auto oldest = std::find_if(inbox_.begin(), inbox_.end(), is_frame);
  const auto next = std::find_if(oldest + 1, inbox_.end(), is_frame);
  if (next != inbox_.end()) next->n += oldest->n;
  pool_.push_back(std::move(oldest->values));
  inbox_.erase(oldest);
  --inbox_frames_;
  while (inbox_.size() > frame_cap_ + context_.options.marks && inbox_.front().kind == Kind::mark) inbox_.pop_front();
}

void Feed::mark(const Mark& mark) {
  Item item;
  item.kind = Kind::mark;
  item.k = mark.k;
  item.text = encode_event("mark", dump(to_json(mark)));
  {
    const std::lock_guard lock(mutex_);
    if (closed_) return;
    push(std::move(item));
  }
  context_.alarm->ring();
}

void Feed::event(std::string_view name, const Json& data) {
  const std::string text = dump(data);
  {
    const std::lock_guard lock(mutex_);
    Item item;
    item.kind = Kind::mark;
    item.k = static_cast<std::int64_t>(++events_);
    item.text = encode_event(name, text, epoch_ + "." + std::to_string(events_));
    push(std::move(item));
    while (inbox_.size() > context_.options.marks) inbox_.pop_front();
  }
  context_.alarm->ring();
}

void Feed::close(std::string_view state) {
  Item item;
  item.kind = Kind::end;
  Json data;
  data["state"] = state;
  auto text = std::make_shared<std::string>(*encode_event("end", dump(data)));
  text->append(kLastChunk);
  item.text = std::move(text);
  {
    const std::lock_guard lock(mutex_);
    if (closed_) return;
    if (has_pending_) flush_pending();
    closed_ = true;
    push(std::move(item));
  }
  context_.alarm->ring();
}

void Feed::drain(std::chrono::nanoseconds now) {
  {
    const std::lock_guard lock(mutex_);
    if (has_pending_ && now >= due_) {
      due_ = std::max(due_, now - interval_) + interval_;
      flush_pending();
    }
    taken_.swap(inbox_);
    inbox_frames_ = 0;
    for (auto& buffer : spare_) pool_.push_back(std::move(buffer));
    if (pool_.size() > frame_cap_) pool_.resize(frame_cap_);
  }
  spare_.clear();
  news_ = news_ || !taken_.empty();
  for (auto& item : taken_) append(std::move(item));
  taken_.clear();
}

void Feed::append(Item item) {
  const std::uint64_t sequence = end();
  if (item.kind == Kind::frame) {
    ++frames_;
    head_ = sequence;
    head_tick_ = item.k;
    item.encoded.resize(topics_.size());
  } else if (item.kind == Kind::mark) {
    if (global()) head_tick_ = item.k;
    marks_.push_back({sequence, item.k, item.text});
    if (marks_.size() > context_.options.marks) {
      marks_lost_before_ = marks_.front().sequence + 1;
      marks_lost_tick_ = marks_.front().k;
      marks_.pop_front();
    }
  }
  history_.push_back(std::move(item));
  trim_history();
}

void Feed::trim_history() {
  const auto over = [&] { return frames_ > frame_cap_ || history_.size() > frame_cap_ + context_.options.marks; };
  while (over() && history_.size() > 1) {
    Item& oldest = history_.front();
    if (oldest.kind == Kind::frame) {
      if (head_ == first_) head_.reset();
      --frames_;
      for (std::size_t topic = 0; topic < oldest.encoded.size(); ++topic) {
        if (oldest.encoded[topic]) rings_[topic].bytes -= oldest.encoded[topic]->size();
      }
      spare_.push_back(std::move(oldest.values));
    }
    history_.pop_front();
    ++first_;
  }
}

Packet Feed::packet(std::size_t topic, std::uint64_t sequence) {
  Item& item = history_[static_cast<std::size_t>(sequence - first_)];
  if (item.kind != Kind::frame) return item.text;
  Packet& slot = item.encoded[topic];
  if (!slot) {
    slot = encode_frame(epoch_, item.k, item.t, item.n, item.values, topics_[topic].signals);
    rings_[topic].bytes += slot->size();
    const Packet kept = slot;
    trim_ring(topic);
    return kept;
  }
  return slot;
}

void Feed::trim_ring(std::size_t topic) {
  Ring& ring = rings_[topic];
  ring.floor = std::max(ring.floor, first_);
  while (ring.bytes > context_.options.ring_bytes && ring.floor + 1 < end()) {
    Item& item = history_[static_cast<std::size_t>(ring.floor - first_)];
    if (item.kind == Kind::frame && item.encoded[topic]) {
      ring.bytes -= item.encoded[topic]->size();
      item.encoded[topic].reset();
    }
    ++ring.floor;
  }
}

}  // namespace vigil
