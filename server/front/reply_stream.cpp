#include "server/front/reply_stream.hpp"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace vigil {

using Clock = std::chrono::steady_clock;

ReplyStream::ReplyStream(std::string head, std::string remote, Spill spill)
    : head_(std::move(head)), remote_(std::move(remote)), spill_(spill) {}

ReplyStream::~ReplyStream() {
  if (spilling_) ++*spill_.slots;
}

ssize_t ReplyStream::read(char* to, std::size_t size) {
  size = std::min(size, head_.size() - at_);
  std::memcpy(to, head_.data() + at_, size);
  at_ += size;
  return static_cast<ssize_t>(size);
}

ssize_t ReplyStream::write(const char* from, std::size_t size) {
  if (failed_) return -1;
  out_.append(from, size);
  if (may_spill_ && out_.size() > spill_.buffer && (!take_slot() || !flush())) {
    failed_ = true;
    return -1;
  }
  return static_cast<ssize_t>(size);
}

/// A slow reader of a long export holds its worker; so only some workers may be held.
bool ReplyStream::take_slot() {
  if (spilling_) return true;
  if (--*spill_.slots < 0) {
    ++*spill_.slots;
    no_slot_ = true;
    return false;
  }
  spilling_ = true;
  return true;
}

bool ReplyStream::flush() {
  std::size_t sent = 0;
  auto deadline = Clock::now() + spill_.stalled;
  while (sent < out_.size()) {
    const ssize_t n = ::send(spill_.socket, out_.data() + sent, out_.size() - sent, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (n > 0) {
      sent += static_cast<std::size_t>(n);
      deadline = Clock::now() + spill_.stalled;
      continue;
    }
    if (n < 0 && errno != EAGAIN && errno != EINTR) return false;
    if (*spill_.aborted || Clock::now() > deadline) return false;
    pollfd wait{spill_.socket, POLLOUT, 0};
    ::poll(&wait, 1, 100);
  }
  out_.clear();
  return true;
}

void ReplyStream::get_remote_ip_and_port(std::string& ip, int& port) const {
  ip = remote_;
  port = 0;
}

void ReplyStream::get_local_ip_and_port(std::string& ip, int& port) const {
  ip.clear();
  port = 0;
}

}  // namespace vigil
