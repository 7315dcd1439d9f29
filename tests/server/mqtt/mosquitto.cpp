#include "tests/server/mqtt/mosquitto.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "server/plant/mqtt.hpp"
#include "tests/server/mqtt/plain_client.hpp"

namespace vigil::mqtt_test {
namespace {

std::string executable() {
  for (const char* path : {"/usr/sbin/mosquitto", "/usr/bin/mosquitto", "/usr/local/sbin/mosquitto"}) {
    if (access(path, X_OK) == 0) return path;
  }
  return {};
}

int free_port() {
  const int listener = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  if (bind(listener, reinterpret_cast<sockaddr*>(&address), size) != 0) return 0;
  getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size);
  close(listener);
  return ntohs(address.sin_port);
}

}  // namespace

std::string why_not() {
  if (!mqtt_missing().empty()) return mqtt_missing();
  return executable().empty() ? "mosquitto is not installed" : "";
}

Mosquitto::~Mosquitto() { end(SIGKILL); }

void Mosquitto::configure() const {
  std::ofstream out(file("mosquitto.conf"));
  out << "per_listener_settings false\nset_tcp_nodelay true\nlog_dest none\nmax_queued_messages 0\n"
      << (getuid() == 0 ? "user root\n" : "")  // else it goes on as another user, who may not write there
      << "persistence true\npersistence_location " << file("") << "\nautosave_interval 1800\n";
  if (more_.find("allow_anonymous") == std::string::npos) out << "allow_anonymous true\n";
  out << "listener " << port_ << " 127.0.0.1\n";
  std::string more = more_;
  for (std::size_t at = more.find("{folder}"); at != std::string::npos; at = more.find("{folder}"))
    more.replace(at, 8, file("."));
  if (tls_)
    // On every address of this machine: 127.0.0.2 is to reach it, too.
    out << "listener " << tls_port_ << " 0.0.0.0\ncafile " << file("ca.crt") << "\ncertfile " << file("server.crt")
        << "\nkeyfile " << file("server.key") << "\n";
  out << more;
}

bool Mosquitto::try_start() {
  configure();
  const std::string program = executable(), config = file("mosquitto.conf");
  pid_ = fork();
  if (pid_ == 0) {
    const int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
    execl(program.c_str(), program.c_str(), "-c", config.c_str(), static_cast<char*>(nullptr));
    _exit(127);
  }
  bool ended = false;
  const bool answers = api_test::eventually([&] {
    const int probe = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port_));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const bool there = ::connect(probe, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
    close(probe);
    ended = !there && waitpid(pid_, nullptr, WNOHANG) == pid_;
    return there || ended;
  });
  if (ended) pid_ = -1;
  return answers && !ended;
}

bool Mosquitto::start() {
  const bool again = port_ != 0;
  for (int attempt = 0; attempt < 5; ++attempt) {
    if (!again) {
      port_ = free_port();
      if (tls_) tls_port_ = free_port();
    }
    if (try_start()) return true;
    end(SIGKILL);
  }
  return false;
}

void Mosquitto::end(int signal) {
  if (pid_ < 0) return;
  kill(pid_, signal);
  waitpid(pid_, nullptr, 0);
  pid_ = -1;
}

}  // namespace vigil::mqtt_test
