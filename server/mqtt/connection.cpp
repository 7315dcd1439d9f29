#include "server/mqtt/connection.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "engine/core/describe.hpp"

namespace vigil {
namespace {

using namespace std::chrono_literals;

constexpr auto kFirstWait = 100ms;  // after a failure; doubled with each further one
constexpr auto kLongestWait = 10'000ms;
constexpr auto kAnswer = 5000ms;  // that a broker may take for an answer
constexpr auto kSlice = 50ms;     // in which an end is noticed
const std::string kHere = "online", kGone = "offline";
constexpr int kUnsent = 200;  // messages under way at once

}  // namespace

std::string paho_address(const std::string& url) {
  const std::size_t colon = url.find("://");
  const std::string scheme = url.substr(0, colon);
  const bool plain = scheme == "tcp" || scheme == "mqtt", tls = scheme == "ssl" || scheme == "mqtts" || scheme == "tls";
  std::string rest = colon == std::string::npos ? "" : url.substr(colon + 3);
  if (rest.ends_with('/')) rest.pop_back();
  const bool clean = !rest.empty() && rest.find_first_of("/@ \t\r\n?#") == std::string::npos && rest.front() != ':';
  if ((!plain && !tls) || !clean)
    throw std::runtime_error("the broker's address is " + in_quotes(url) +
                             "; expected tcp://HOST[:PORT] or ssl://HOST[:PORT]");
  const std::size_t port = rest.rfind(':');
  const bool bare = port == std::string::npos || (rest.front() == '[' && port < rest.find(']'));
  if (bare) return (plain ? "tcp://" : "ssl://") + rest + (plain ? ":1883" : ":8883");
  const std::string digits = rest.substr(port + 1);
  if (digits.empty() || digits.size() > 5 ||
      !std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; }) ||
      std::stoi(digits) < 1 || std::stoi(digits) > 65535)
    throw std::runtime_error("the broker's address is " + in_quotes(url) + "; its port is none");
  return (plain ? "tcp://" : "ssl://") + rest;
}

MqttConnection::MqttConnection(const MqttOptions& options, MqttRole role)
    : options_(options),
      role_(std::move(role)),
      address_(paho_address(options.url)),
      client_(address_, role_.client, kUnsent, nullptr) {
  client_.set_connection_lost_handler([this](const std::string&) {
    connected_ = false;
    failed("the connection was lost");
    wake_.notify_all();
  });
  client_.set_message_callback([this](mqtt::const_message_ptr message) {
    try {
      if (message && role_.message) role_.message(*message);
    } catch (const std::exception& error) {
      failed(error.what());  // nothing may pass through the library's C
    }
  });
  thread_ = std::thread([this] { main(); });
}

MqttConnection::~MqttConnection() {
  stop_ = true;
  wake_.notify_all();
  thread_.join();
  try {
    client_.disable_callbacks();
  } catch (const std::exception&) {
    // The library refuses while it is connecting; its end is the client's own, next.
  }
}

mqtt::connect_options MqttConnection::connect_options() {
  mqtt::connect_options options;
  options.set_mqtt_version(MQTTVERSION_3_1_1);
  options.set_clean_session(!role_.keeps_session);
  options.set_keep_alive_interval(20s);
  options.set_connect_timeout(4s);
  options.set_max_inflight(kUnsent);
  const BrokerCredentials& who = options_.credentials;
  if (!who.user.empty()) options.set_user_name(who.user);
  if (!who.password.empty()) options.set_password(who.password);
  if (!role_.status_topic.empty())
    options.set_will(mqtt::will_options(role_.status_topic, kGone.data(), kGone.size(), 1, true));
  if (!address_.starts_with("ssl://")) return options;
  mqtt::ssl_options tls;
  if (!who.ca.empty()) tls.set_trust_store(who.ca);
  if (!who.certificate.empty()) tls.set_key_store(who.certificate);
  if (!who.key.empty()) tls.set_private_key(who.key);
  if (!who.key_password.empty()) tls.set_private_key_password(who.key_password);
  tls.set_ssl_version(MQTT_SSL_VERSION_TLS_1_2);
  tls.set_enable_server_cert_auth(true);
  tls.set_verify(true);  // the name in the certificate is the host's
  tls.set_error_handler([this](const std::string& text) {
    const std::lock_guard lock(mutex_);
    tls_error_ = text;
  });
  options.set_ssl(tls);
  return options;
}

bool MqttConnection::wait(const mqtt::token_ptr& token, std::chrono::milliseconds patience) const {
  for (auto left = patience; left > 0ms && !stop_; left -= kSlice) {
    if (token->wait_for(kSlice)) return true;  // throws what the broker answered
  }
  return false;
}

void MqttConnection::failed(const std::string& sentence) {
  if (stop_) return;
  const std::lock_guard lock(mutex_);
  std::string whole = sentence;
  if (!tls_error_.empty()) whole += " (" + tls_error_.substr(0, tls_error_.find('\n')) + ")";
  if (error_.empty()) spdlog::warn("the broker {} is not there, and is tried for ever: {}", address_, whole);
  error_ = whole;
}

bool MqttConnection::connect() {
  try {
    {
      const std::lock_guard lock(mutex_);
      tls_error_.clear();
    }
    if (!wait(client_.connect(connect_options()), kAnswer)) {
      failed("it does not answer");
      return false;
    }
    subscribe();
  } catch (const std::exception& error) {
    failed(error.what());
    if (client_.is_connected()) leave();  // what it refuses now it may grant later
    return false;
  }
  {
    const std::lock_guard lock(mutex_);
    if (!error_.empty() || connections_ == 0) spdlog::info("connected to the broker {}", address_);
    error_.clear();
  }
  connected_ = client_.is_connected();
  ++connections_;
  if (!role_.status_topic.empty()) publish(role_.status_topic, kHere, true, kAnswer);
  return connected_;
}

void MqttConnection::subscribe() {
  for (const std::string& filter : role_.filters) {
    if (!wait(client_.subscribe(filter, 1), kAnswer))
      throw std::runtime_error("it does not take the subscription " + filter);
  }
}

void MqttConnection::leave() {
  if (!role_.status_topic.empty() && connected_) say_gone();
  connected_ = false;
  try {
    client_.disconnect(200)->wait_for(1s);
  } catch (const std::exception&) {
    // It was gone already.
  }
}

/// An orderly end keeps the broker from saying it.
void MqttConnection::say_gone() {
  try {
    client_.publish(role_.status_topic, kGone.data(), kGone.size(), 1, true)->wait_for(500ms);
  } catch (const std::exception&) {
    // It was gone already.
  }
}

void MqttConnection::main() {
  auto pause = kFirstWait;
  while (!stop_) {
    bool away = false;
    {
      const std::lock_guard lock(mutex_);
      away = away_;
    }
    if (away && client_.is_connected()) leave();
    if (!away && !client_.is_connected()) {
      connected_ = false;
      pause = connect() ? kFirstWait : std::min<std::chrono::milliseconds>(2 * pause, kLongestWait);
    }
    std::unique_lock lock(mutex_);
    const auto news = [&] { return stop_ || away_ != away; };
    if (away || connected_)
      wake_.wait_for(lock, 1s, [&] { return news() || (!away && !connected_); });
    else
      wake_.wait_for(lock, pause, news);
  }
  leave();
}

void MqttConnection::hold(bool away) {
  {
    const std::lock_guard lock(mutex_);
    away_ = away;
  }
  wake_.notify_all();
}

bool MqttConnection::publish(const std::string& topic, const std::string& text, bool retained,
                             std::chrono::milliseconds patience) {
  if (!connected_) return false;
  try {
    const auto token = client_.publish(topic, text.data(), text.size(), 1, retained);
    for (auto left = patience; left > 0ms && !stop_ && connected_; left -= kSlice) {
      if (token->wait_for(kSlice)) return true;
    }
  } catch (const std::exception& error) {
    spdlog::debug("{}: {}", topic, error.what());
  }
  return false;
}

Json MqttConnection::status() const {
  const std::lock_guard lock(mutex_);
  return {{"url", address_},
          {"connected", connected_.load()},
          {"connections", connections_.load()},
          {"held", away_},
          {"error", error_.empty() ? Json() : Json(error_)}};
}

}  // namespace vigil
