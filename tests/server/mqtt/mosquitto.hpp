/// A real broker on loopback, in a folder of its own.
#pragma once

#include <sys/types.h>

#include <string>

#include "tests/server/api/temporary.hpp"

namespace vigil::mqtt_test {

/// Why these tests cannot be run; empty: they can.
std::string why_not();

class Mosquitto {
 public:
  /// `more`: further lines of its configuration; {folder} is its folder. With a TLS port where `tls` is true, whose
  /// certificates (ca.crt, server.crt, server.key) are then in the folder before start().
  explicit Mosquitto(std::string more = {}, bool tls = false) : more_(std::move(more)), tls_(tls) {}
  ~Mosquitto();
  Mosquitto(const Mosquitto&) = delete;
  Mosquitto& operator=(const Mosquitto&) = delete;

  /// On a free port the first time, on the same again after end(). False where it does not answer.
  bool start();
  /// SIGTERM: it writes what it keeps; SIGKILL: it does not.
  void end(int signal);
  int port() const { return port_; }
  int tls_port() const { return tls_port_; }
  std::string url() const { return "tcp://127.0.0.1:" + std::to_string(port_); }
  std::string file(const std::string& name) const { return folder_.file(name); }

 private:
  bool try_start();
  void configure() const;

  const api_test::TemporaryFolder folder_;
  std::string more_;
  bool tls_;
  int port_ = 0, tls_port_ = 0;
  pid_t pid_ = -1;
};

}  // namespace vigil::mqtt_test
