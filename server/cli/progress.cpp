#include "server/cli/progress.hpp"

#include <unistd.h>

#include <iostream>
#include <utility>

namespace vigil {

Progress::Progress(std::string what, std::int64_t total)
    : what_(std::move(what)),
      total_(total),
      terminal_(isatty(STDERR_FILENO) == 1),
      next_(std::chrono::steady_clock::now() + std::chrono::milliseconds(500)) {}

Progress::~Progress() {
  if (written_) std::cerr << "\r\033[K" << std::flush;
}

void Progress::at(std::int64_t done) {
  if (!terminal_) return;
  const auto now = std::chrono::steady_clock::now();
  if (now < next_) return;
  next_ = now + std::chrono::milliseconds(200);
  written_ = true;
  std::cerr << "\r\033[K" << what_ << " " << done;
  if (total_ >= 0) std::cerr << " of " << total_;
  std::cerr << std::flush;
}

}  // namespace vigil
