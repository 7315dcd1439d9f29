/// A real broker and real workers, as processes that can be killed.
#pragma once

#include <sys/types.h>

#include <memory>
#include <string>
#include <vector>

#include "tests/server/api/fixture.hpp"

namespace vigil::api_test {

/// A process in the background, its outputs in a file; killed when this goes.
class BackgroundProcess {
 public:
  /// environment: NAME=VALUE added to ours.
  BackgroundProcess(std::vector<std::string> words, std::string output, std::vector<std::string> environment = {});
  ~BackgroundProcess() { end(); }
  BackgroundProcess(const BackgroundProcess&) = delete;
  BackgroundProcess& operator=(const BackgroundProcess&) = delete;
  bool running();
  /// Sends the signal and waits; the exit code, 128 + signal where one ended it, -1 where it was over.
  int end(int signal = 9);
  /// Waits for it to end by itself, up to two minutes; -1 where it did not.
  int wait();
  std::string output() const;

 private:
  pid_t pid_ = -1;
  int code_ = -1;
  std::string output_;
};

/// nats-server with JetStream on a free port of the loopback, its store in a folder of its own.
class BrokerProcess {
 public:
  /// Empty where a broker can be started; else why not.
  static std::string missing();
  /// lines: of its configuration, beside port and store.
  explicit BrokerProcess(std::string lines = {});
  std::string url() const { return "nats://127.0.0.1:" + std::to_string(port_); }
  const TemporaryFolder& folder() const { return folder_; }
  void kill() { process_->end(9); }
  /// On the same port, with what it had stored or without.
  void start(bool keep_store = true);
  std::string output() const { return process_->output(); }

 private:
  bool launch();
  TemporaryFolder folder_;
  std::string lines_;
  int port_ = 0;
  std::unique_ptr<BackgroundProcess> process_;
};

/// `vigil worker` with one thread.
std::unique_ptr<BackgroundProcess> start_worker(const BrokerProcess& broker, const std::string& name,
                                                std::vector<std::string> environment = {});

}  // namespace vigil::api_test
