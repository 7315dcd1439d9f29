/// The load: many viewers of one stream in one thread, counting what they are sent.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace vigil::bench {

/// Viewers of one stream, read by whoever calls receive.
class Viewers {
 public:
  explicit Viewers(int count);
  ~Viewers();
  Viewers(const Viewers&) = delete;
  Viewers& operator=(const Viewers&) = delete;

  void connect(int port, const std::string& path);  ///< to 127.0.0.1
  void receive(int milliseconds);                   ///< waits at most that long, reads what there is
  void receive_for(double seconds);
  int started() const { return started_; }  ///< that got something
  std::uint64_t frames() const { return frames_; }
  std::uint64_t bytes() const { return bytes_; }

 private:
  struct Viewer {
    int socket = -1;
    bool started = false;
    std::size_t matched = 0;  ///< bytes of a frame's mark at the end of what came
  };
  void take(Viewer& viewer);
  void count_marks(Viewer& viewer, std::string_view text);

  std::vector<Viewer> viewers_;
  int epoll_;
  std::vector<char> buffer_;
  int started_ = 0;
  std::uint64_t frames_ = 0;
  std::uint64_t bytes_ = 0;
};

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
