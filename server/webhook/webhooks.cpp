#include "server/webhook/webhooks.hpp"

#include <httplib.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <charconv>
#include <utility>

#include "engine/core/describe.hpp"
#include "engine/core/input_error.hpp"
#include "engine/run/frame.hpp"

namespace vigil {
namespace {

constexpr std::string_view kScheme = "http://";

[[noreturn]] void refuse(const Json& value, const std::string& why) {
  throw InputError("/webhook", "webhook is " + shown(value) + "; " + why, "http://HOST[:PORT]/PATH");
}

}  // namespace

WebhookUrl read_webhook(const Json& value, const std::vector<std::string>& allowed) {
  if (!value.is_string()) refuse(value, "expected an address");
  const auto& text = value.get_ref<const std::string&>();
  const auto plain = [](char c) { return c > 0x20 && c < 0x7f && c != '#' && c != '\\' && c != '"'; };
  if (!text.starts_with(kScheme) || text.size() > 2000 || !std::all_of(text.begin(), text.end(), plain))
    refuse(value, "expected an address that begins with http://");
  const std::size_t slash = std::min(text.find_first_of("/?", kScheme.size()), text.size());
  std::string host = text.substr(kScheme.size(), slash - kScheme.size());
  WebhookUrl url;
  if (slash < text.size()) url.path = (text[slash] == '?' ? "/" : "") + text.substr(slash);
  const std::size_t colon = host.rfind(':');
  const bool six = !host.empty() && host.front() == '[';
  if (colon != std::string::npos && (!six || colon > host.find(']'))) {
    const char* const end = host.data() + host.size();
    const auto read = std::from_chars(host.data() + colon + 1, end, url.port);
    if (read.ec != std::errc() || read.ptr != end || url.port < 1 || url.port > 65535)
      refuse(value, "its port is none");
    host.resize(colon);
  }
  if (six && host.size() > 2) host = host.substr(1, host.size() - 2);
  if (host.empty() || host.find('@') != std::string::npos) refuse(value, "it names no host");
  if (std::find(allowed.begin(), allowed.end(), host) == allowed.end())
    refuse(value, "this server may not call " + in_quotes(host) + ": it was not started with --allow-webhook " + host);
  url.host = host;
  return url;
}

Webhooks::Webhooks(WebhookOptions options, Note late) : options_(std::move(options)), late_(std::move(late)) {
  if (!options_.allow.empty()) thread_ = std::thread([this] { work(); });
}

Webhooks::~Webhooks() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
    if (calling_ != nullptr) calling_->stop();
  }
  wake_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void Webhooks::open(RunId run, WebhookUrl url) {
  const std::lock_guard lock(mutex_);
  hooks_[run].url = std::move(url);
}

void Webhooks::send(RunId run, const Mark& mark) {
  Json alarm = to_json(mark);
  {
    const std::lock_guard lock(mutex_);
    const auto place = hooks_.find(run);
    if (place == hooks_.end()) return;
    Hook& hook = place->second;
    if (hook.waiting.size() >= options_.queue) {
      hook.waiting.pop_front();
      ++hook.dropped;
    }
    hook.waiting.push_back(std::move(alarm));
  }
  wake_.notify_all();
}

std::vector<Mark> Webhooks::notes(RunId run) {
  if (told_.load(std::memory_order_relaxed) == 0) return {};
  const std::lock_guard lock(mutex_);
  const auto place = hooks_.find(run);
  if (place == hooks_.end()) return {};
  told_ -= static_cast<int>(place->second.notes.size());
  return std::exchange(place->second.notes, {});
}

void Webhooks::close(RunId run) {
  {
    const std::lock_guard lock(mutex_);
    const auto place = hooks_.find(run);
    if (place == hooks_.end()) return;
    place->second.over = true;
    if (place->second.waiting.empty() && !place->second.busy) hooks_.erase(place);
  }
  wake_.notify_all();
}

/// The hook that has waited longest of those that may be called now; none: `wake` is when one may.
Webhooks::Hooks::iterator Webhooks::next(Clock::time_point& wake) {
  wake = Clock::now() + std::chrono::hours(1);
  auto best = hooks_.end();
  for (auto place = hooks_.begin(); place != hooks_.end(); ++place) {
    if (place->second.waiting.empty() || place->second.due >= wake) continue;
    wake = place->second.due;
    best = place;
  }
  return wake <= Clock::now() ? best : hooks_.end();
}

void Webhooks::work() {
  std::unique_lock lock(mutex_);
  while (!stop_) {
    Clock::time_point wake;
    const auto place = next(wake);
    if (place == hooks_.end()) {
      wake_.wait_until(lock, wake);
    } else {
      deliver(place, lock);
    }
  }
}

void Webhooks::deliver(Hooks::iterator place, std::unique_lock<std::mutex>& lock) {
  const RunId run = place->first;
  Hook& hook = place->second;  // stays: nobody else erases one that is busy
  const std::size_t count = std::min(hook.waiting.size(), options_.batch);
  const std::int64_t dropped = hook.dropped;
  Json body{{"run", std::to_string(run)}, {"dropped", dropped}, {"alarms", Json::array()}};
  for (std::size_t i = 0; i < count; ++i) {
    body["alarms"].push_back(std::move(hook.waiting.front()));
    hook.waiting.pop_front();
  }
  hook.busy = true;
  const WebhookUrl url = hook.url;
  lock.unlock();
  const bool arrived = post(url, body.dump());
  lock.lock();
  hook.busy = false;
  if (!arrived) {
    for (std::size_t i = count; i-- > 0;) hook.waiting.push_front(std::move(body["alarms"][i]));
  }
  settle(run, hook, arrived, count, dropped);
  if (hook.over && (hook.waiting.empty() || hook.failures >= options_.tries)) hooks_.erase(run);
}

bool Webhooks::post(const WebhookUrl& url, const std::string& body) {
  httplib::Client client(url.host, url.port);
  client.set_connection_timeout(options_.timeout);
  client.set_read_timeout(options_.timeout);
  client.set_write_timeout(options_.timeout);
  {
    const std::lock_guard lock(mutex_);
    if (stop_) return false;
    calling_ = &client;
  }
  const auto result = client.Post(url.path.c_str(), body, "application/json");
  {
    const std::lock_guard lock(mutex_);
    calling_ = nullptr;
  }
  return result && result->status >= 200 && result->status < 300;
}

void Webhooks::settle(RunId run, Hook& hook, bool arrived, std::size_t sent, std::int64_t dropped) {
  if (arrived) {
    if (hook.failures >= options_.tries)
      note(run, hook, "webhook_answers",
           "The webhook answers again: " + std::to_string(sent) + " alarms arrived, " + std::to_string(dropped) +
               " were given up meanwhile.");
    hook.failures = 0;
    hook.dropped -= dropped;
    return;
  }
  ++hook.failures;
  if (hook.failures == options_.tries)
    note(run, hook, "webhook_failing",
         "The webhook at " + hook.url.host + " does not take alarms; the newest " + std::to_string(options_.queue) +
             " are kept for it" + (hook.over ? " no longer." : "."));
  hook.due = Clock::now() + std::min(options_.longest_wait, options_.wait * (1 << std::min(hook.failures - 1, 10)));
}

void Webhooks::note(RunId run, Hook& hook, const std::string& code, const std::string& sentence) {
  spdlog::warn("run {}: {}", run, sentence);
  Mark mark;
  mark.type = MarkType::note;
  mark.code = code;
  mark.detail = sentence;
  if (!hook.waiting.empty()) mark.k = hook.waiting.back().at("k").get<std::int64_t>();
  if (hook.over) return late_(run, mark);
  hook.notes.push_back(std::move(mark));
  ++told_;
}

}  // namespace vigil
