/// The loop: accepts, reads, checks, hands to workers, writes, and feeds the hub's viewers. One thread; all
/// non-blocking.
#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

#include "server/front/connection.hpp"
#include "server/front/door.hpp"
#include "server/front/front.hpp"
#include "server/front/workers.hpp"
#include "server/hub/hub.hpp"

namespace vigil {

struct LoopCounters {
  std::atomic<std::uint64_t> requests{0};
  std::atomic<std::uint64_t> refused{0};
  std::atomic<std::uint64_t> bytes_streamed{0};
  std::atomic<std::size_t> connections{0};
};

class Loop {
 public:
  /// listener: a bound, listening, non-blocking socket, owned from here on. Throws std::runtime_error: no descriptors
  /// left.
  Loop(const FrontOptions& options, const Door& door, Hub& hub, int listener);
  ~Loop();
  Loop(const Loop&) = delete;
  Loop& operator=(const Loop&) = delete;

  void set_workers(Workers* workers) { workers_ = workers; }
  void run();  ///< until stop() and everything is done, or the bound is over
  /// Closes what is left; working_too: once no worker runs any more.
  void release(bool working_too);
  // From any thread:
  void stop();
  void finished(Done done);
  void wake();
  const LoopCounters& counters() const { return counters_; }

 private:
  using Clock = Connection::Clock;
  using State = Connection::State;

  // loop.cpp
  int turn_timeout() const;
  void handle(Connection& connection, std::uint32_t events);
  void sweep();
  void expire(Connection& connection);
  void take_finished();
  void begin_stop();
  bool stopped() const;

  // loop_accept.cpp
  void accept_all();
  void admit(int socket, const sockaddr_storage& peer);
  void pause_accepting();
  void resume_accepting();
  void close(Connection& connection);
  void bury();
  void arm(Connection& connection, std::uint32_t events);

  // loop_read.cpp
  void readable(Connection& connection);
  void advance(Connection& connection);  ///< as far as what has come in allows
  bool step_head(Connection& connection);
  bool step_body(Connection& connection);
  void admit_request(Connection& connection);
  void complete(Connection& connection);
  void dispatch(Connection& connection, HttpRequest request);
  HttpRequest make_request(Connection& connection);

  // loop_write.cpp
  void reply(Connection& connection, std::string bytes, bool keep_alive);
  void refuse(Connection& connection, const Refusal& refusal, const HeaderList& headers, bool keep_alive);
  bool step_write(Connection& connection);
  void open_stream(Connection& connection, HttpRequest request);
  void start_viewing(Connection& connection, std::shared_ptr<Viewer> viewer);
  void pump(Connection& connection);
  void set_blocked(Connection& connection, bool blocked);

  const FrontOptions& options_;
  const Door& door_;
  Hub& hub_;
  Workers* workers_ = nullptr;
  LoopCounters counters_;

  int listener_ = -1;
  int epoll_ = -1;
  int wake_ = -1;
  bool accepting_ = true;
  Clock::time_point accept_again_;
  Clock::time_point next_sweep_;
  Clock::time_point next_collect_;
  bool stopping_ = false;
  Clock::time_point stop_by_;
  std::atomic<bool> stop_asked_{false};

  std::uint64_t next_id_ = 1;
  std::string id_prefix_;
  std::uint64_t next_request_ = 1;
  std::unordered_map<std::uint64_t, std::unique_ptr<Connection>> connections_;
  std::vector<Connection*> dead_;
  std::map<std::string, std::size_t> per_address_;
  std::size_t bodies_ = 0;  ///< bytes announced by bodies that are coming in
  std::string buffer_;

  std::mutex done_mutex_;
  std::vector<Done> done_;
};

}  // namespace vigil
