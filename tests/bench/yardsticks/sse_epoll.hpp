/// The yardstick of the stream: a bare epoll loop that sends frames of a given size at a given rate, and nothing else.
#pragma once

#include <cstddef>

namespace vigil::bench {

/// Serves `GET` requests on a listening socket with an event stream until SIGTERM (then the process exits with 0): each
/// frame is encoded once into one ring of 64, each client is a cursor, one that falls out is told so. bytes: of a frame
/// without its chunk framing. It carries "ts", the monotonic time in nanoseconds.
[[noreturn]] void serve_sse_epoll(int listener, double frames_per_second, std::size_t bytes);

/// A non-blocking listening socket on a free loopback port.
int listen_on_loopback(int& port);

}  // namespace vigil::bench
