/// A child process with one channel to its standard input and output.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <string>
#include <string_view>

namespace vigil {

/// Killed and reaped at the end of its scope. The kernel kills it when the thread that started it ends.
class ChildProcess {
 public:
  /// Starts `executable argument`. Standard error goes nowhere. Throws std::system_error where no process can be had.
  ChildProcess(const std::string& executable, const std::string& argument);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  enum class End { closed, late, woken, too_much };
  struct Talk {
    End end = End::closed;
    std::string answer;
  };
  /// Says `text` and listens until the child closes its output, the deadline passes, `wake` becomes readable (-1:
  /// never) or the answer grows beyond `most` bytes. Neither side can block the other.
  Talk talk(std::string_view text, std::chrono::steady_clock::time_point deadline, int wake, std::size_t most);
  /// Kills the child, if it still lives, and says how it ended: "ended with code 3", "was ended by signal 9 (Killed)".
  std::string finish();

 private:
  void say(std::string_view& rest);
  bool listen(std::string& answer);

  pid_t pid_ = -1;
  int channel_ = -1;
};

}  // namespace vigil
