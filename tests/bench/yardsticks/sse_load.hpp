/// The load: many viewers of one stream in one thread, counting what they are sent.
#pragma once

#include <sys/types.h>

#include <string>

namespace vigil::bench {

struct Load {
  int viewers = 1000;
  double warm_up = 1.5;  ///< s
  double seconds = 3;    ///< measured
};

struct LoadResult {
  int connected = 0;
  double frames_per_second = 0;  ///< received by all viewers together
  double server_cpu = 0;         ///< seconds of the server's process a second
  double bytes_per_frame = 0;    ///< of payload on the wire, framing included
  double frames_per_cpu_second() const { return server_cpu > 0 ? frames_per_second / server_cpu : 0; }
};

/// Connects to 127.0.0.1:port, asks for `path`, and watches the server's process while the viewers read.
LoadResult watch(int port, const std::string& path, pid_t server, const Load& load);

/// CPU seconds a process used so far, all its threads.
double process_cpu(pid_t process);

}  // namespace vigil::bench
