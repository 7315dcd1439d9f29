/// cpp-httplib behind the door: it is fed one whole, checked request at a time and writes the answer's bytes.
#pragma once

#include <httplib.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>

#include "server/front/message.hpp"
#include "server/front/route.hpp"
#include "server/front/static_files.hpp"

namespace vigil {

/// One request for a worker.
struct Job {
  std::uint64_t connection = 0;
  int socket = -1;  ///< untouched by the loop until the job is done
  HttpRequest request;
  std::string target;
  const Route* route = nullptr;  ///< null: a file of the page
  bool head_only = false;
  bool keep_alive = true;
};

/// What came of it.
struct Done {
  std::uint64_t connection = 0;
  std::string bytes;  ///< to be written by the loop
  bool keep_alive = false;
  bool failed = false;  ///< the connection cannot be used any more: a streamed body was cut
};

struct BulkLimits {
  std::size_t buffer = 1u << 20;              ///< bytes of a streamed body before it is written past the loop
  int slots = 4;                              ///< streamed bodies at once; beyond: 503
  std::chrono::milliseconds stalled{20'000};  ///< without progress
};

class Engine : private httplib::Server {
 public:
  Engine(const Routes& routes, const StaticFiles& files, BulkLimits limits);
  /// Runs the handler and collects its answer. Any thread, many at once. Never throws.
  Done run(Job& job);
  /// Streamed bodies stop at once.
  void abort() { aborted_ = true; }

 private:
  void answer(const Job& job, httplib::Response& response);
  void fill(const Job& job, HttpResponse& response);

  const Routes& routes_;
  const StaticFiles& files_;
  const BulkLimits limits_;
  std::atomic<int> slots_;
  std::atomic<bool> aborted_{false};
};

}  // namespace vigil
