/// One reader of a topic: a position, and the few packets that are on their way to it.
#pragma once

#include <sys/uio.h>

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "server/hub/feed.hpp"

namespace vigil {

class Viewer {
 public:
  Viewer(std::shared_ptr<Feed> feed, std::size_t topic);

  /// Decides where to begin and queues hello (and a gap, where something is lost). Call once.
  void begin(std::string_view last_event_id);

  /// Fills up to `count` parts with what is to be sent next; 0: nothing now.
  int gather(iovec* parts, int count);
  /// Says how many of those bytes went out.
  void sent(std::size_t bytes);
  /// Everything was sent, the end included.
  bool finished() const { return ended_ && outgoing_.empty(); }
  /// Ends the stream after what is already on its way (the server stops).
  void finish();
  /// Queues a ping, unless the viewer is behind anyway.
  void ping(const Packet& packet);

  const std::shared_ptr<Feed>& feed() const { return feed_; }
  void* owner = nullptr;  ///< the front's connection
  std::size_t index = 0;  ///< in the feed's list

 private:
  void start_fresh();
  bool resume(std::int64_t k);
  void start_with_gap(std::int64_t after, std::string_view reason, bool known);
  void hello(bool resumed, std::int64_t from);
  Packet next();
  Packet jump();
  Packet gap(std::int64_t from, std::int64_t to, std::string_view reason, std::uint64_t marks_since) const;

  std::shared_ptr<Feed> feed_;
  std::size_t topic_;
  std::uint64_t position_ = 0;  ///< of the next item
  std::uint64_t marks_at_ = 0;  ///< below position_: marks of a part that was jumped over are sent first
  std::int64_t last_tick_ = -1;
  std::deque<Packet> special_;   ///< hello, gap, ping: before anything else
  std::deque<Packet> outgoing_;  ///< handed to the socket; the first one maybe in part
  std::size_t offset_ = 0;
  bool ended_ = false;
};

}  // namespace vigil
