/// The real executable as a child process.
#pragma once

#include <sys/types.h>

#include <memory>
#include <string>
#include <vector>

namespace vigil::api_test {

struct Outcome {
  int code = -1;       ///< exit code; 128 + signal if one ended it
  std::string output;  ///< of standard output
  std::string error;   ///< of standard error
};

/// Runs `vigil ARGUMENTS` to its end.
Outcome vigil_command(const std::vector<std::string>& arguments);

/// `vigil serve --port 0 ARGUMENTS` in the background; killed when this goes.
class ServerProcess {
 public:
  /// Waits for the first line; throws std::runtime_error with what it said instead.
  explicit ServerProcess(const std::vector<std::string>& arguments);
  ~ServerProcess();
  ServerProcess(const ServerProcess&) = delete;
  ServerProcess& operator=(const ServerProcess&) = delete;
  int port() const { return port_; }
  pid_t pid() const { return pid_; }
  const std::string& first_line() const { return line_; }
  /// Sends the signal and waits; the exit code as in Outcome.
  int end(int signal);

 private:
  pid_t pid_ = -1;
  int output_ = -1;
  int port_ = 0;
  std::string line_;
};

}  // namespace vigil::api_test
