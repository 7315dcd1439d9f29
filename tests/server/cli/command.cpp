#include "tests/server/cli/command.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <stdexcept>
#include <thread>

namespace vigil::api_test {
namespace {

pid_t start(const std::vector<std::string>& arguments, int output, int error) {
  std::vector<std::string> words{VIGIL_EXECUTABLE};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const pid_t pid = fork();
  if (pid == 0) {
    dup2(output, STDOUT_FILENO);
    if (error >= 0) dup2(error, STDERR_FILENO);
    execv(argv[0], argv.data());
    _exit(126);
  }
  return pid;
}

std::string read_all(int file) {
  std::string text;
  char part[4096];
  for (ssize_t n = read(file, part, sizeof part); n > 0; n = read(file, part, sizeof part))
    text.append(part, static_cast<std::size_t>(n));
  close(file);
  return text;
}

int wait_for(pid_t pid) {
  int status = 0;
  waitpid(pid, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

Outcome vigil_command(const std::vector<std::string>& arguments) {
  int output[2], error[2];
  if (pipe2(output, O_CLOEXEC) != 0 || pipe2(error, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  const pid_t pid = start(arguments, output[1], error[1]);
  close(output[1]);
  close(error[1]);
  Outcome outcome;
  std::thread reader([&] { outcome.error = read_all(error[0]); });
  outcome.output = read_all(output[0]);
  reader.join();
  outcome.code = wait_for(pid);
  return outcome;
}

ServerProcess::ServerProcess(const std::vector<std::string>& arguments) {
  int output[2];
  if (pipe2(output, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  std::vector<std::string> all{"serve", "--port", "0"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  pid_ = start(all, output[1], -1);
  close(output[1]);
  output_ = output[0];
  char c = 0;
  while (read(output_, &c, 1) == 1 && c != '\n') line_ += c;
  const std::size_t colon = line_.rfind(':');
  if (line_.rfind("vigil ", 0) != 0 || colon == std::string::npos) {
    end(SIGKILL);
    throw std::runtime_error("the server did not start: " + line_);
  }
  port_ = std::stoi(line_.substr(colon + 1));
}

ServerProcess::~ServerProcess() { end(SIGKILL); }

int ServerProcess::end(int signal) {
  if (pid_ < 0) return -1;
  kill(pid_, signal);
  const int code = wait_for(pid_);
  close(output_);
  pid_ = -1;
  return code;
}

}  // namespace vigil::api_test
