/// A line of progress on standard error, where that is a terminal.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace vigil {

class Progress {
 public:
  /// `what`: "tick", "run". total < 0: unknown.
  Progress(std::string what, std::int64_t total);
  ~Progress();  ///< clears the line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  void at(std::int64_t done);  ///< cheap; writes a few times a second

 private:
  std::string what_;
  std::int64_t total_;
  bool terminal_;
  bool written_ = false;
  std::chrono::steady_clock::time_point next_;
};

}  // namespace vigil
