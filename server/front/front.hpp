/// The door: one accept and epoll loop on the port, a bounded pool of workers behind it, the hub's viewers in the loop
/// itself.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "server/front/route.hpp"
#include "server/front/static_files.hpp"
#include "server/front/token.hpp"

namespace vigil {

class Hub;

struct FrontOptions {
  std::string host = "127.0.0.1";
  int port = 8080;                       ///< 0: a free one
  std::vector<std::string> allow_hosts;  ///< names beside loopback, `host` and the address the client connected to
  Tokens tokens;

  int workers = 8;
  std::size_t queue = 256;            ///< requests waiting for a worker; beyond: 503 with Retry-After
  std::size_t body_limit = 8u << 20;  ///< bytes, unless the route says otherwise
  std::size_t connections = 8192;
  std::size_t per_address = 256;  ///< connections of one address, 0: no limit; loopback is exempt (see below)
  bool cap_loopback = false;      ///< per_address holds for loopback too
  std::chrono::milliseconds head_deadline{10'000};
  std::chrono::milliseconds body_deadline{60'000};   ///< plus one second per 100 kB announced
  std::chrono::milliseconds idle_deadline{30'000};   ///< between requests of a kept connection
  std::chrono::milliseconds write_deadline{20'000};  ///< without progress while an answer is written
  std::chrono::milliseconds stuck_deadline{60'000};  ///< of a viewer that takes nothing
  std::chrono::milliseconds stop_deadline{1'500};
};

struct FrontStats {
  std::uint64_t requests = 0;  ///< that reached a worker
  std::uint64_t refused = 0;   ///< answered 4xx or 503 by the door itself
  std::uint64_t bytes_streamed = 0;
  std::size_t connections = 0;
  std::size_t viewers = 0;
  std::size_t queued = 0;
};

class Front {
 public:
  /// Adds POST and DELETE /api/v1/session to `routes` by itself. `hub` outlives the front.
  Front(FrontOptions options, Routes routes, Hub& hub, StaticFiles files = {});
  ~Front();  ///< stops

  /// Binds, listens, starts the loop and the workers. Throws std::runtime_error with one sentence if the port cannot be
  /// had.
  void start();
  int port() const;
  /// Stops accepting, lets running requests finish within the bound, ends the viewers' streams. Returns within 2 s
  /// unless a handler does not return: that one is waited for (handlers must be bounded).
  void stop();
  const Routes& routes() const;  ///< with the front's own
  FrontStats stats() const;      ///< any thread

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vigil
