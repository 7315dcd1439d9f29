/// Alarms of runs, sent to receivers of the user's own. One thread; no run ever waits for it.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "db/records.hpp"
#include "engine/core/json.hpp"

namespace httplib {
class Client;
}

namespace vigil {

struct WebhookUrl {
  std::string host;
  int port = 80;
  std::string path = "/";
};

/// http://host[:port][/path], its host among `allowed`. Throws InputError at /webhook.
WebhookUrl read_webhook(const Json& value, const std::vector<std::string>& allowed);

struct WebhookOptions {
  std::vector<std::string> allow;       ///< hosts; none: no run may have a webhook
  std::size_t queue = 256;              ///< alarms that wait, for each run; more push out the oldest
  std::size_t batch = 64;               ///< alarms a call
  int tries = 3;                        ///< in vain, before the run is told; at the end of a run, before it is given up
  std::chrono::milliseconds wait{500};  ///< after the first failure; doubled with each further one
  std::chrono::milliseconds longest_wait{30'000};
  std::chrono::milliseconds timeout{1000};  ///< to connect, to write, to read
};

class Webhooks {
 public:
  using Note = std::function<void(RunId, const Mark&)>;
  /// `late` takes notes about runs that are over, on this object's thread.
  Webhooks(WebhookOptions options, Note late);
  ~Webhooks();  ///< what is not sent yet is not sent
  Webhooks(const Webhooks&) = delete;
  Webhooks& operator=(const Webhooks&) = delete;

  const WebhookOptions& options() const { return options_; }

  // Any thread; none of these waits for a receiver.

  void open(RunId run, WebhookUrl url);
  /// Queues the mark. Runs without a webhook are ignored, here and below.
  void send(RunId run, const Mark& mark);
  /// What the receiver did since the last call: marks of type note (codes webhook_failing, webhook_answers).
  std::vector<Mark> notes(RunId run);
  /// The run is over: what waits is sent, or given up after so many tries.
  void close(RunId run);

 private:
  using Clock = std::chrono::steady_clock;
  struct Hook {
    WebhookUrl url;
    std::deque<Json> waiting;
    std::vector<Mark> notes;
    std::int64_t dropped = 0;  ///< pushed out since the last call that arrived
    int failures = 0;          ///< in a row
    bool over = false;
    bool busy = false;  ///< being called
    Clock::time_point due{};
  };
  using Hooks = std::map<RunId, Hook>;

  void work();
  Hooks::iterator next(Clock::time_point& wake);
  void deliver(Hooks::iterator place, std::unique_lock<std::mutex>& lock);
  bool post(const WebhookUrl& url, const std::string& body);
  void settle(RunId run, Hook& hook, bool arrived, std::size_t sent, std::int64_t dropped);
  void note(RunId run, Hook& hook, const std::string& code, const std::string& sentence);

  const WebhookOptions options_;
  const Note late_;
  std::mutex mutex_;
  std::condition_variable wake_;
  Hooks hooks_;
  std::atomic<int> told_{0};            ///< notes that wait to be fetched
  httplib::Client* calling_ = nullptr;  ///< so that the end need not wait for a receiver
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace vigil
