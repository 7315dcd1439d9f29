#include "server/nats/connection.hpp"

#include <algorithm>
#include <condition_variable>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "server/nats/credentials.hpp"

namespace vigil {
namespace {

constexpr std::int64_t kWait = 500;          // ms between two attempts to connect
constexpr std::int64_t kPing = 5000;         // ms: two of them without an answer and the broker is gone
constexpr std::int64_t kDeadline = 10'000;   // ms that a write may take
constexpr std::size_t kLeastRoom = 1 << 16;  // bytes, where the broker has not said

void check(natsStatus status, const std::string& what) {
  if (status == NATS_CONNECTION_CLOSED) throw BrokerRefusal("the broker refused the connection for good");
  if (status != NATS_OK) throw std::runtime_error(what + ": " + natsStatus_GetText(status));
}

void add_servers(natsOptions* options, const std::string& url) {
  std::vector<std::string> urls;
  std::istringstream list(url);
  for (std::string one; std::getline(list, one, ',');) urls.push_back(one);
  std::vector<const char*> words;
  for (const std::string& one : urls) {
    const bool known = one.starts_with("nats://") || one.starts_with("tls://");
    if (!known || one.find("://") + 3 >= one.size())
      throw std::runtime_error("the broker's URL is \"" + one + "\"; expected nats://HOST:PORT or tls://HOST:PORT");
    words.push_back(one.c_str());
  }
  if (words.empty()) throw std::runtime_error("the broker's URL is empty; expected nats://HOST:PORT");
  check(natsOptions_SetServers(options, words.data(), static_cast<int>(words.size())), "the broker's URL");
  const auto secret = [](const std::string& one) { return one.starts_with("tls://"); };
  if (std::any_of(urls.begin(), urls.end(), secret)) check(natsOptions_SetSecure(options, true), "TLS");
}

}  // namespace

std::string_view text_of(const natsMsg* message) {
  return {natsMsg_GetData(message), static_cast<std::size_t>(natsMsg_GetDataLength(message))};
}

NatsConnection::NatsConnection(const NatsOptions& given) : options_(given) {
  natsOptions* raw = nullptr;
  check(natsOptions_Create(&raw), "NATS");
  const NatsOwned<natsOptions> options(raw);
  add_servers(raw, options_.url);
  add_credentials(raw, options_.credentials);
  natsOptions_SetName(raw, options_.name.c_str());
  natsOptions_SetMaxReconnect(raw, -1);
  natsOptions_SetReconnectWait(raw, kWait);
  natsOptions_SetPingInterval(raw, kPing);
  natsOptions_SetMaxPingsOut(raw, 2);
  natsOptions_SetWriteDeadline(raw, kDeadline);
  natsOptions_SetRetryOnFailedConnect(raw, true, &on_connected, this);
  natsOptions_SetReconnectedCB(raw, &on_connected, this);
  natsOptions_SetDisconnectedCB(raw, &on_lost, this);
  natsOptions_SetClosedCB(raw, &on_closed, this);
  natsOptions_SetErrorHandler(
      raw, [](natsConnection*, natsSubscription*, natsStatus, void*) {}, nullptr);
  natsConnection* connection = nullptr;
  const natsStatus status = natsConnection_Connect(&connection, raw);
  connection_.reset(connection);
  if (status == NATS_NOT_YET_CONNECTED) {
    lost_ = true;
    say("the broker at " + options_.url + " is not reachable; it is tried again for ever");
  } else {
    check(status, "the broker at " + options_.url + " cannot be used");
    ++times_;
  }
  jsCtx* streams = nullptr;
  const natsStatus made = natsConnection_JetStream(&streams, connection, nullptr);
  streams_.reset(streams);
  if (made != NATS_OK) close();
  check(made, "JetStream");
}

NatsConnection::~NatsConnection() { close(); }

void NatsConnection::close() {
  ending_ = true;
  streams_.reset();
  natsConnection_Close(connection_.get());
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return closed_; });
}

void NatsConnection::on_connected(natsConnection* /*connection*/, void* self) {
  auto& own = *static_cast<NatsConnection*>(self);
  ++own.times_;
  if (own.lost_.exchange(false)) own.say("the broker is there");
}

void NatsConnection::on_lost(natsConnection* /*connection*/, void* self) {
  auto& own = *static_cast<NatsConnection*>(self);
  if (!own.ending_ && !own.lost_.exchange(true)) own.say("the broker is gone; it is tried again for ever");
}

void NatsConnection::on_closed(natsConnection* connection, void* self) {
  auto& own = *static_cast<NatsConnection*>(self);
  const std::lock_guard lock(own.mutex_);
  own.closed_ = true;
  own.changed_.notify_all();
  if (own.ending_) return;
  const char* reason = nullptr;
  natsConnection_GetLastError(connection, &reason);
  own.refusal_ = "the broker at " + own.options_.url + " refused the connection";
  if (reason != nullptr && *reason != '\0') own.refusal_ += std::string(": ") + reason;
}

bool NatsConnection::connected() const {
  return natsConnection_Status(connection_.get()) == NATS_CONN_STATUS_CONNECTED;
}

std::string NatsConnection::refusal() const {
  const std::lock_guard lock(mutex_);
  return refusal_;
}

std::size_t NatsConnection::room() const {
  const std::int64_t most = natsConnection_GetMaxPayload(connection_.get());
  return most > 0 ? static_cast<std::size_t>(most) : kLeastRoom;
}

bool NatsConnection::publish(const std::string& subject, std::string_view data) const {
  if (!connected()) return false;
  const auto size = static_cast<int>(data.size());
  return natsConnection_Publish(connection_.get(), subject.c_str(), data.data(), size) == NATS_OK;
}

void NatsConnection::say(const std::string& sentence) const {
  if (options_.say) options_.say(sentence);
}

struct NatsListener::End {
  std::mutex mutex;
  std::condition_variable changed;
  bool over = false;
};

NatsListener::NatsListener(const NatsConnection& connection, const std::string& subject, Each each)
    : each_(std::make_unique<Each>(std::move(each))), end_(std::make_shared<End>()) {
  const auto call = [](natsConnection*, natsSubscription*, natsMsg* message, void* each_one) {
    const NatsOwned<natsMsg> owned(message);
    (*static_cast<Each*>(each_one))(message);
  };
  natsSubscription* raw = nullptr;
  check(natsConnection_Subscribe(&raw, connection.get(), subject.c_str(), call, each_.get()), "subscribing");
  subscription_.reset(raw);
  const auto over = [](void* end) {
    auto& own = *static_cast<End*>(end);
    const std::lock_guard lock(own.mutex);
    own.over = true;
    own.changed.notify_all();
  };
  check(natsSubscription_SetOnCompleteCB(raw, over, end_.get()), "subscribing");
}

NatsListener::~NatsListener() {
  natsSubscription_Unsubscribe(subscription_.get());
  std::unique_lock lock(end_->mutex);
  end_->changed.wait(lock, [this] { return end_->over; });
}

}  // namespace vigil
