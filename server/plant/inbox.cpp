#include "server/plant/inbox.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

#include "engine/core/describe.hpp"
#include "server/front/message.hpp"

namespace vigil {
namespace {

using namespace std::chrono_literals;

constexpr auto kRetry = 20ms;  // between two looks at runs that are behind
constexpr std::size_t kReasons = 8;
constexpr std::size_t kTold = 1000;

}  // namespace

PlantInbox::PlantInbox(std::vector<TopicPattern> patterns, Find find, InboxOptions options)
    : patterns_(std::move(patterns)), find_(std::move(find)), options_(options), thread_([this] { work(); }) {}

PlantInbox::~PlantInbox() { stop(); }

void PlantInbox::stop() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
    on_pause_ = nullptr;
  }
  wake_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void PlantInbox::on_pause(std::function<void(bool)> paused) {
  const std::lock_guard lock(mutex_);
  on_pause_ = std::move(paused);
  if (on_pause_ && paused_) on_pause_(true);
}

void PlantInbox::deliver(std::string topic, std::string payload) {
  auto message = std::make_shared<const Message>(Message{std::move(topic), std::move(payload), Clock::now()});
  {
    const std::lock_guard lock(mutex_);
    if (stop_) return;
    ++received_;
    bytes_ += message->bytes();
    queue_.push_back(std::move(message));
    if (!paused_ && bytes_ > options_.full) {
      paused_ = true;
      if (on_pause_) on_pause_(true);
    }
    if (queue_.size() > 1) return;  // the worker is awake
  }
  wake_.notify_one();
}

void PlantInbox::free(std::size_t bytes) {
  const std::lock_guard lock(mutex_);
  bytes_ -= bytes;
  if (!paused_ || bytes_ > options_.low) return;
  paused_ = false;
  if (on_pause_) on_pause_(false);
}

void PlantInbox::work() {
  std::unique_lock lock(mutex_);
  while (!stop_) {
    std::deque<std::shared_ptr<const Message>> batch;
    batch.swap(queue_);
    lock.unlock();
    for (auto& message : batch) handle(std::move(message));
    retry();
    lock.lock();
    const auto something = [this] { return stop_ || !queue_.empty(); };
    if (parked_.empty())
      wake_.wait(lock, something);
    else
      wake_.wait_for(lock, kRetry, something);
  }
}

/// Every pattern that the topic is one of is a way to runs; a run gets the message once.
void PlantInbox::handle(std::shared_ptr<const Message> message) {
  if (message->payload.size() > options_.payload) {
    refuse(message->topic, "The payload is longer than " + std::to_string(options_.payload) + " bytes.");
    return free(message->bytes());
  }
  std::set<RunId> served;
  std::string wanted;
  for (const TopicPattern& pattern : patterns_) {
    const auto place = pattern.match(message->topic);
    if (!place) continue;
    wanted = place->run;
    for (const auto& run : find_(place->run)) {
      if (served.insert(run->id()).second) feed(run, *place, message);
    }
  }
  if (served.empty()) without_run(message->topic, wanted);
  const std::size_t bytes = message->bytes();
  const bool kept = std::any_of(served.begin(), served.end(), [this](RunId id) { return parked_.contains(id); });
  if (!kept) free(bytes);
}

void PlantInbox::feed(const std::shared_ptr<LiveRun>& run, const TopicPlace& place,
                      const std::shared_ptr<const Message>& message) {
  const auto waiting = parked_.find(run->id());
  if (waiting != parked_.end()) {
    waiting->second.push_back({run, place, message});
  } else if (give(*run, place, *message) == Fate::behind) {
    parked_[run->id()].push_back({run, place, message});
    const std::lock_guard lock(mutex_);
    behind_.push_back(std::to_string(run->id()));
  }
}

PlantInbox::Fate PlantInbox::give(LiveRun& run, const TopicPlace& place, const Message& message) {
  std::string sentence;
  try {
    if (run.wait_ended(0ms)) return Fate::over;
    run.order().feed->take(place, message.payload, message.at);
    run.wake();
    const std::lock_guard lock(mutex_);
    ++taken_;
    return Fate::taken;
  } catch (const RunRefusal&) {
    return Fate::behind;
  } catch (const std::exception& error) {
    sentence = error.what();
  }
  run.order().feed->refused(in_quotes(message.topic) + ": " + sentence);
  refuse(message.topic, "run " + std::to_string(run.id()) + ": " + sentence);
  return Fate::refused;
}

void PlantInbox::retry() {
  if (parked_.empty()) return;
  for (auto place = parked_.begin(); place != parked_.end();) {
    auto& waiting = place->second;
    while (!waiting.empty()) {
      Parked& first = waiting.front();
      if (give(*first.run, first.place, *first.message) == Fate::behind) break;
      const std::size_t bytes = first.message->bytes();
      const bool last = first.message.use_count() == 1;  // no other run waits for it
      waiting.pop_front();
      if (last) free(bytes);
    }
    place = waiting.empty() ? parked_.erase(place) : std::next(place);
  }
  const std::lock_guard lock(mutex_);
  behind_.clear();
  for (const auto& [id, waiting] : parked_) behind_.push_back(std::to_string(id));
}

void PlantInbox::refuse(const std::string& topic, const std::string& sentence) {
  const std::string whole = in_quotes(topic) + ": " + sentence;
  if (told_.size() < kTold && told_.insert("refused " + topic).second)
    spdlog::warn("a message of the plant was refused, and others of its topic are only counted: {}", whole);
  const std::lock_guard lock(mutex_);
  ++refused_;
  newest_.push_back(whole);
  if (newest_.size() > kReasons) newest_.pop_front();
}

void PlantInbox::without_run(const std::string& topic, const std::string& run) {
  if (told_.size() < kTold && told_.insert("run " + run).second)
    spdlog::warn("messages of the plant are for no run{}: the first is of topic {}",
                 run.empty() ? "" : " (" + in_quotes(run) + ")", in_quotes(topic));
  const std::lock_guard lock(mutex_);
  ++no_run_;
}

Json PlantInbox::status() const {
  const std::lock_guard lock(mutex_);
  return {{"received", received_},     {"taken", taken_},         {"no_run", no_run_}, {"refused", refused_},
          {"newest_refused", newest_}, {"waiting_bytes", bytes_}, {"behind", behind_}};
}

}  // namespace vigil
