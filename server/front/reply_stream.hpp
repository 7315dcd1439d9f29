/// The socket as cpp-httplib sees it: reads from memory, writes to memory, and past a limit (streamed bodies only) to
/// the socket itself, with a bound on how long the other side may take nothing.
#pragma once

#include <httplib.h>

#include <atomic>
#include <chrono>
#include <string>

namespace vigil {

class ReplyStream : public httplib::Stream {
 public:
  struct Spill {
    int socket = -1;
    std::size_t buffer = 0;
    std::chrono::milliseconds stalled{0};
    std::atomic<int>* slots = nullptr;
    const std::atomic<bool>* aborted = nullptr;
  };

  ReplyStream(std::string head, std::string remote, Spill spill);
  ~ReplyStream() override;
  ReplyStream(const ReplyStream&) = delete;
  ReplyStream& operator=(const ReplyStream&) = delete;

  /// From here on the body may be written past the loop.
  void allow_spill() { may_spill_ = true; }
  bool spilled() const { return spilling_; }      ///< bytes went out already
  bool no_slot() const { return no_slot_; }       ///< too many streamed bodies at once; nothing went out
  std::string take() { return std::move(out_); }  ///< what is still to be written

  bool is_readable() const override { return at_ < head_.size(); }
  bool is_writable() const override { return !failed_; }
  ssize_t read(char* to, std::size_t size) override;
  ssize_t write(const char* from, std::size_t size) override;
  void get_remote_ip_and_port(std::string& ip, int& port) const override;
  void get_local_ip_and_port(std::string& ip, int& port) const override;
  socket_t socket() const override { return spill_.socket; }

 private:
  bool take_slot();
  bool flush();

  std::string head_;
  std::size_t at_ = 0;
  std::string remote_;
  Spill spill_;
  std::string out_;
  bool may_spill_ = false;
  bool spilling_ = false;
  bool no_slot_ = false;
  bool failed_ = false;
};

}  // namespace vigil
