/// One client's socket, as the loop keeps it.
#pragma once

#include <netinet/in.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include "server/front/door.hpp"
#include "server/front/head.hpp"

namespace vigil {

class Viewer;

struct Connection {
  using Clock = std::chrono::steady_clock;
  enum class State {
    head,       ///< a request's head is coming in (or nothing is)
    body,       ///< its body is
    working,    ///< a worker has it; the socket is out of epoll
    writing,    ///< the answer goes out
    streaming,  ///< a viewer of the hub
    lingering   ///< answered and shut; waiting for the client to close, so that it reads the answer before a reset
  };

  int socket = -1;
  std::uint64_t id = 0;
  State state = State::head;
  bool dead = false;         ///< closed; buried at the end of the loop's turn
  std::uint32_t events = 0;  ///< epoll's mask; 0: not in epoll
  in6_addr address{};
  std::string remote;
  std::string local;
  Clock::time_point deadline;

  std::string in;  ///< received, not yet taken
  HeadScan scan;
  Head head;
  Pass pass;
  std::string body;
  std::size_t body_wanted = 0;

  std::string out;
  std::size_t out_at = 0;
  bool keep_alive = false;

  std::shared_ptr<Viewer> viewer;
  bool blocked = false;
  Clock::time_point progress;  ///< when a blocked viewer last took something
};

}  // namespace vigil
