/// A bounded pool: jobs in, answers out.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "server/front/engine.hpp"

namespace vigil {

class Workers {
 public:
  /// `finished` is called on a worker's thread for every job taken.
  Workers(Engine& engine, int threads, std::size_t queue, std::function<void(Done)> finished);
  ~Workers();
  /// False, and the job untouched, when the queue is full.
  bool submit(Job& job);
  std::size_t queued() const;
  /// Drops what waits, lets what runs finish. Returns when all threads have ended.
  void stop();

 private:
  void work();

  Engine& engine_;
  const std::size_t limit_;
  const std::function<void(Done)> finished_;
  mutable std::mutex mutex_;
  std::condition_variable ready_;
  std::deque<Job> jobs_;
  bool stopping_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace vigil
