/// A connection to NATS that never gives up, and what is taken from its library: handles that free themselves.
#pragma once

#include <nats/nats.h>

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

#include "server/crew/broker.hpp"

namespace vigil {

struct NatsFree {
  void operator()(natsOptions* options) const { natsOptions_Destroy(options); }
  void operator()(natsConnection* connection) const { natsConnection_Destroy(connection); }
  void operator()(jsCtx* stream) const { jsCtx_Destroy(stream); }
  void operator()(natsMsg* message) const { natsMsg_Destroy(message); }
  void operator()(natsSubscription* subscription) const { natsSubscription_Destroy(subscription); }
  void operator()(jsStreamInfo* info) const { jsStreamInfo_Destroy(info); }
  void operator()(jsConsumerInfo* info) const { jsConsumerInfo_Destroy(info); }
  void operator()(jsStreamNamesList* names) const { jsStreamNamesList_Destroy(names); }
};
template <class Thing>
using NatsOwned = std::unique_ptr<Thing, NatsFree>;

std::string_view text_of(const natsMsg* message);

/// Safe from any thread.
class NatsConnection {
 public:
  /// Throws std::runtime_error with one sentence where the options cannot be used. Returns before there is a broker.
  explicit NatsConnection(const NatsOptions& options);
  ~NatsConnection();
  NatsConnection(const NatsConnection&) = delete;
  NatsConnection& operator=(const NatsConnection&) = delete;

  natsConnection* get() const { return connection_.get(); }
  jsCtx* streams() const { return streams_.get(); }
  bool connected() const;
  /// How often it has been connected: another number, and what was under way may be lost.
  std::uint64_t times() const { return times_; }
  /// Why it will not come back (the broker refused it); empty: it will.
  std::string refusal() const;
  /// Bytes that a message may have.
  std::size_t room() const;
  bool publish(const std::string& subject, std::string_view data) const;
  void say(const std::string& sentence) const;

 private:
  static void on_connected(natsConnection* connection, void* self);
  static void on_lost(natsConnection* connection, void* self);
  static void on_closed(natsConnection* connection, void* self);
  /// Until the library's thread has made its last call back.
  void close();

  NatsOptions options_;
  std::atomic<std::uint64_t> times_{0};
  std::atomic<bool> lost_{false}, ending_{false};
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  bool closed_ = false;  ///< no call back comes any more
  std::string refusal_;
  NatsOwned<natsConnection> connection_;
  NatsOwned<jsCtx> streams_;
};

/// Calls back for every message of a subject, on a thread of the library's, until it goes: then no call is left.
class NatsListener {
 public:
  using Each = std::function<void(natsMsg* message)>;
  /// Throws std::runtime_error.
  NatsListener(const NatsConnection& connection, const std::string& subject, Each each);
  ~NatsListener();
  NatsListener(const NatsListener&) = delete;
  NatsListener& operator=(const NatsListener&) = delete;

 private:
  struct End;
  std::unique_ptr<Each> each_;
  std::shared_ptr<End> end_;
  NatsOwned<natsSubscription> subscription_;
};

}  // namespace vigil
