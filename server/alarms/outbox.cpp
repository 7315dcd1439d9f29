#include "server/alarms/outbox.hpp"

#include <spdlog/spdlog.h>

#include <chrono>
#include <utility>

namespace vigil {
namespace {

using namespace std::chrono_literals;

constexpr auto kAgain = 100ms;  // after a failure, and between two looks at a sink that is away
constexpr auto kLook = 1s;      // at what somebody keeps
constexpr auto kEnd = 1s;       // that the end waits for the sink

}  // namespace

Outbox::Outbox(std::unique_ptr<AlarmSink> sink, Right right, std::size_t most)
    : sink_(std::move(sink)), right_(std::move(right)), most_(most), thread_([this] { work(); }) {}

Outbox::~Outbox() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

void Outbox::put(Announcement announcement, bool lasting) {
  {
    const std::lock_guard lock(mutex_);
    if (announcement.kept) {
      if (lasting)
        lasting_[announcement.topic] = announcement.text;
      else
        lasting_.erase(announcement.topic);
      kept_[announcement.topic] = std::move(announcement.text);
    } else {
      passing_.push_back(std::move(announcement));
      if (passing_.size() > most_) {
        if (dropped_++ == 0) spdlog::warn("{}: more than {} alarms wait; the oldest are dropped", sink_->name(), most_);
        passing_.pop_front();
      }
    }
  }
  wake_.notify_one();
}

std::optional<Announcement> Outbox::next() {
  kept_turn_ = !kept_turn_;
  if (!kept_.empty() && (kept_turn_ || passing_.empty())) {
    auto first = kept_.extract(kept_.begin());
    return Announcement{std::move(first.key()), std::move(first.mapped()), true};
  }
  if (passing_.empty()) return std::nullopt;
  Announcement first = std::move(passing_.front());
  passing_.pop_front();
  return first;
}

void Outbox::give_back(Announcement announcement) {
  if (announcement.kept)
    kept_.try_emplace(std::move(announcement.topic), std::move(announcement.text));  // a newer one stays
  else
    passing_.push_front(std::move(announcement));
}

/// After every connection: the broker may have lost what it kept.
void Outbox::greet(std::unique_lock<std::mutex>& lock) {
  lock.unlock();
  const std::uint64_t connections = sink_->connections();
  lock.lock();
  if (connections == greeted_) return;
  greeted_ = connections;
  for (const auto& [topic, text] : lasting_) kept_.try_emplace(topic, text);
}

/// What somebody keeps and should not, of runs that ended while nobody was there to say so.
void Outbox::correct(std::unique_lock<std::mutex>& lock) {
  lock.unlock();
  std::map<std::string, std::string> right;
  for (const auto& [topic, text] : sink_->kept()) {
    if (const auto should = right_(topic, text)) right[topic] = *should;
  }
  lock.lock();
  for (auto& [topic, text] : right) {
    if (!lasting_.contains(topic)) kept_.try_emplace(topic, std::move(text));
  }
}

void Outbox::work() {
  std::unique_lock lock(mutex_);
  std::optional<std::chrono::steady_clock::time_point> end;
  for (;;) {
    if (stop_ && !end) end = std::chrono::steady_clock::now() + kEnd;
    if (stop_ && (!sink_->connected() || std::chrono::steady_clock::now() >= *end)) return;
    if (!sink_->connected()) {
      wake_.wait_for(lock, kAgain, [this] { return stop_; });
      continue;
    }
    greet(lock);
    correct(lock);
    auto announcement = next();
    if (!announcement) {
      if (stop_) return;
      wake_.wait_for(lock, kLook);
      continue;
    }
    lock.unlock();
    const bool arrived = sink_->send(*announcement);
    lock.lock();
    if (arrived) {
      ++sent_;
      continue;
    }
    give_back(std::move(*announcement));
    wake_.wait_for(lock, kAgain, [this] { return stop_; });
  }
}

Json Outbox::status() const {
  Json status = sink_->status();
  const std::lock_guard lock(mutex_);
  status["sent"] = sent_;
  status["dropped"] = dropped_;
  status["waiting"] = passing_.size() + kept_.size();
  return status;
}

}  // namespace vigil
