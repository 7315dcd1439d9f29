#include "tests/server/nats/processes.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "server/crew/broker.hpp"

namespace vigil::api_test {
namespace {

constexpr const char* kBrokers[] = {"/usr/sbin/nats-server", "/usr/bin/nats-server", "/usr/local/bin/nats-server"};

std::string executable() {
  for (const char* path : kBrokers) {
    if (access(path, X_OK) == 0) return path;
  }
  return {};
}

sockaddr_in loopback(int port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return address;
}

int free_port() {
  const int file = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address = loopback(0);
  socklen_t size = sizeof address;
  const bool got = bind(file, reinterpret_cast<sockaddr*>(&address), size) == 0 &&
                   getsockname(file, reinterpret_cast<sockaddr*>(&address), &size) == 0;
  close(file);
  if (!got) throw std::runtime_error("no free port");
  return ntohs(address.sin_port);
}

bool answers(int port) {
  const int file = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const sockaddr_in address = loopback(port);
  const bool there = connect(file, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  close(file);
  return there;
}

}  // namespace

BackgroundProcess::BackgroundProcess(std::vector<std::string> words, std::string output,
                                     std::vector<std::string> environment)
    : output_(std::move(output)) {
  for (char** one = environ; *one != nullptr; ++one) environment.emplace_back(*one);
  std::vector<char*> argv, envp;
  for (std::string& word : words) argv.push_back(word.data());
  for (std::string& word : environment) envp.push_back(word.data());
  argv.push_back(nullptr);
  envp.push_back(nullptr);
  pid_ = fork();
  if (pid_ != 0) return;
  const int file = open(output_.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
  dup2(file, STDOUT_FILENO);
  dup2(file, STDERR_FILENO);
  execve(argv[0], argv.data(), envp.data());
  _exit(126);
}

bool BackgroundProcess::running() {
  int status = 0;
  if (pid_ < 0 || waitpid(pid_, &status, WNOHANG) == 0) return pid_ >= 0;
  code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  pid_ = -1;
  return false;
}

int BackgroundProcess::end(int signal) {
  if (!running()) return -1;
  ::kill(pid_, signal);
  return wait();
}

int BackgroundProcess::wait() {
  for (int patience = 0; patience < 4; ++patience) {
    if (eventually([this] { return !running(); })) return code_;
  }
  return -1;
}

std::string BackgroundProcess::output() const {
  std::ostringstream text;
  text << std::ifstream(output_).rdbuf();
  return text.str();
}

std::string BrokerProcess::missing() {
  if (executable().empty()) return "nats-server is not installed";
  try {
    connect_nats({});
  } catch (const std::runtime_error& failure) {
    const std::string why = failure.what();
    if (why.find("without NATS") != std::string::npos) return why;
  }
  return {};
}

BrokerProcess::BrokerProcess(std::string lines) : lines_(std::move(lines)) {
  for (int attempt = 0; attempt < 5; ++attempt) {
    port_ = free_port();
    if (launch()) return;
  }
  throw std::runtime_error("the broker did not start: " + process_->output());
}

void BrokerProcess::start(bool keep_store) {
  if (!keep_store) std::filesystem::remove_all(folder_.file("store"));
  // Its port may be another's for a moment: of a connection, say, that was made while it was away.
  if (!eventually([this] { return launch(); })) throw std::runtime_error("no broker again: " + process_->output());
}

bool BrokerProcess::launch() {
  const std::string config = folder_.file("broker.conf");
  std::ofstream(config) << "listen: 127.0.0.1:" << port_ << "\njetstream { store_dir: \"" << folder_.file("store")
                        << "\" }\n"
                        << lines_ << "\n";
  process_.reset();
  process_ = std::make_unique<BackgroundProcess>(std::vector<std::string>{executable(), "-c", config},
                                                 folder_.file("broker.log"));
  return eventually([this] { return answers(port_) || !process_->running(); }) && process_->running();
}

std::unique_ptr<BackgroundProcess> start_worker(const BrokerProcess& broker, const std::string& name,
                                                std::vector<std::string> environment) {
  return std::make_unique<BackgroundProcess>(
      std::vector<std::string>{VIGIL_EXECUTABLE, "worker", "--nats", broker.url(), "--threads", "1", "--name", name},
      broker.folder().file(name + ".log"), std::move(environment));
}

}  // namespace vigil::api_test
