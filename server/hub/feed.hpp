/// One run's stream (or the global one): an inbox that the publisher fills, and a history that the loop reads from.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "server/hub/encode.hpp"
#include "server/hub/hub.hpp"

namespace vigil {

/// Wakes the reading thread once, however many publishers call before it looks.
class Alarm {
 public:
  void ring();
  void reset() { rung_.store(false); }
  void set(std::function<void()> waker);

 private:
  std::atomic<bool> rung_{false};
  std::mutex mutex_;
  std::function<void()> waker_;
};

/// What all feeds of a hub share.
struct FeedContext {
  HubOptions options;
  std::shared_ptr<Alarm> alarm;
};

class Feed {
 public:
  enum class Kind { frame, mark, end };
  struct Item {
    Kind kind = Kind::frame;
    std::int64_t k = 0;
    double t = 0;
    std::int64_t n = 1;           ///< ticks it stands for
    std::vector<double> values;   ///< of a frame
    Packet text;                  ///< of a mark or the end
    std::vector<Packet> encoded;  ///< of a frame, by topic, made when first asked for
  };

  Feed(FeedContext context, std::int64_t run, std::string epoch, int signals, std::vector<HubTopic> topics, double dt);

  // The publisher's side.
  void frame(const Frame& frame);
  void mark(const Mark& mark);
  /// An event of the global feed: its id is epoch.<number>.
  void event(std::string_view name, const Json& data);
  void close(std::string_view state);
  std::size_t viewer_count() const { return viewer_count_.load(std::memory_order_relaxed); }

  // The reader's side, one thread only.
  /// Takes the inbox in, and a thinned tick if it is due.
  void drain(std::chrono::nanoseconds now);
  /// Whether anything came in since this was asked last.
  bool take_news() { return std::exchange(news_, false); }
  std::uint64_t first() const { return first_; }  ///< of the oldest item still there
  std::uint64_t end() const { return first_ + history_.size(); }
  /// The oldest item that topic can still give.
  std::uint64_t low(std::size_t topic) const { return std::max(first_, rings_[topic].floor); }
  const Item& item(std::uint64_t sequence) const { return history_[static_cast<std::size_t>(sequence - first_)]; }
  /// The bytes of an item in [low, end).
  Packet packet(std::size_t topic, std::uint64_t sequence);
  struct KeptMark {
    std::uint64_t sequence;
    std::int64_t k;
    Packet text;
  };
  /// The first kept mark at or after `sequence`, or null.
  const KeptMark* mark_from(std::uint64_t sequence) const;
  /// The first kept mark of a tick after k: its sequence, or end().
  std::uint64_t mark_after_tick(std::int64_t k) const;
  std::uint64_t first_mark() const { return marks_.empty() ? end() : marks_.front().sequence; }
  /// Marks below this sequence are gone, the last of them of tick marks_lost_tick().
  std::uint64_t marks_lost_before() const { return marks_lost_before_; }
  std::int64_t marks_lost_tick() const { return marks_lost_tick_; }
  /// The newest frame's sequence, empty before the first.
  std::optional<std::uint64_t> head() const { return head_; }
  /// The newest tick known, -1 before the first; of the global feed: the newest event's number.
  std::int64_t head_tick() const { return head_tick_; }
  /// The newest tick that the newest frame does not stand for: what somebody who starts with that frame misses.
  std::int64_t tick_before_head() const { return head_ ? item(*head_).k - item(*head_).n : head_tick_; }
  /// Where somebody goes on who has everything up to tick (event) k; empty if something after it is gone, or k is yet
  /// to come.
  std::optional<std::uint64_t> position_after(std::size_t topic, std::int64_t k) const;

  std::int64_t run() const { return run_; }
  bool global() const { return run_ < 0; }
  const std::string& epoch() const { return epoch_; }
  double dt() const { return dt_; }
  const std::vector<HubTopic>& topics() const { return topics_; }

  std::vector<std::shared_ptr<Viewer>> viewers;
  std::chrono::nanoseconds next_ping{0};
  void viewers_changed() { viewer_count_.store(viewers.size(), std::memory_order_relaxed); }

 private:
  struct Ring {
    std::uint64_t floor = 0;
    std::size_t bytes = 0;
  };
  Item fresh_item();
  void push(Item item);
  void shed_inbox();
  void flush_pending();
  void append(Item item);
  void trim_history();
  void trim_ring(std::size_t topic);

  const FeedContext context_;
  const std::int64_t run_;
  const std::string epoch_;
  const double dt_;
  const std::vector<HubTopic> topics_;
  const std::size_t frame_cap_;
  const std::chrono::nanoseconds interval_;
  std::atomic<std::size_t> viewer_count_{0};

  std::mutex mutex_;
  std::deque<Item> inbox_;
  std::size_t inbox_frames_ = 0;
  std::vector<std::vector<double>> pool_;  ///< buffers of shed frames, used again
  Item pending_;
  bool has_pending_ = false;
  bool closed_ = false;
  std::int64_t ticks_ = 0;  ///< since the last frame that went out
  std::chrono::nanoseconds due_{0};
  std::uint64_t events_ = 0;

  std::deque<Item> history_;
  std::deque<Item> taken_;
  bool news_ = false;
  std::uint64_t first_ = 0;
  std::size_t frames_ = 0;
  std::optional<std::uint64_t> head_;
  std::vector<Ring> rings_;
  std::deque<KeptMark> marks_;
  std::uint64_t marks_lost_before_ = 0;
  std::int64_t marks_lost_tick_ = -1;
  std::int64_t head_tick_ = -1;
  std::vector<std::vector<double>> spare_;
};

}  // namespace vigil
