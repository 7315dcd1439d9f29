#include "server/synthesis/child_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstring>
#include <system_error>

namespace vigil {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kNotStarted = 127;  // the shell's own code for it

[[noreturn]] void refuse(const char* what) { throw std::system_error(errno, std::generic_category(), what); }

/// Between fork and exec of a process with many threads: nothing but what a signal handler may call.
[[noreturn]] void become(const char* executable, const char* argument, int channel, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(kNotStarted);  // it died before it could be tied to
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);  // a server's threads block the signals that end it
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (dup2(channel, STDIN_FILENO) < 0 || dup2(channel, STDOUT_FILENO) < 0 || dup2(nowhere, STDERR_FILENO) < 0) {
    _exit(kNotStarted);
  }
  close_range(STDERR_FILENO + 1, ~0U, 0);
  char* const words[] = {const_cast<char*>(executable), const_cast<char*>(argument), nullptr};
  execv(executable, words);
  _exit(kNotStarted);
}

int milliseconds_until(Clock::time_point deadline) {
  const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
  return static_cast<int>(std::clamp<std::int64_t>(left + 1, 0, 1'000'000));
}

}  // namespace

ChildProcess::ChildProcess(const std::string& executable, const std::string& argument) {
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) refuse("no channel");
  const pid_t parent = getpid();
  pid_ = fork();
  if (pid_ == 0) become(executable.c_str(), argument.c_str(), ends[1], parent);
  close(ends[1]);
  channel_ = ends[0];
  if (pid_ < 0) {
    const int why = errno;
    close(channel_);
    errno = why;
    refuse("no process");
  }
  fcntl(channel_, F_SETFL, O_NONBLOCK);
}

ChildProcess::~ChildProcess() {
  finish();
  close(channel_);
}

void ChildProcess::say(std::string_view& rest) {
  const ssize_t written = send(channel_, rest.data(), rest.size(), MSG_NOSIGNAL);
  if (written > 0) rest.remove_prefix(static_cast<std::size_t>(written));
  // A child that reads no more may still have answered.
  if (written < 0 && errno != EAGAIN && errno != EINTR) rest = {};
  if (rest.empty()) shutdown(channel_, SHUT_WR);
}

/// False when the child has closed its end.
bool ChildProcess::listen(std::string& answer) {
  char part[64 << 10];
  const ssize_t n = recv(channel_, part, sizeof part, 0);
  if (n > 0) answer.append(part, static_cast<std::size_t>(n));
  return n > 0 || (n < 0 && (errno == EAGAIN || errno == EINTR));
}

ChildProcess::Talk ChildProcess::talk(std::string_view text, Clock::time_point deadline, int wake, std::size_t most) {
  Talk talk;
  for (;;) {
    const short interest = text.empty() ? POLLIN : POLLIN | POLLOUT;
    pollfd watched[2] = {{channel_, interest, 0}, {wake, POLLIN, 0}};
    poll(watched, 2, milliseconds_until(deadline));
    if (watched[1].revents != 0) talk.end = End::woken;
    if (Clock::now() >= deadline) talk.end = End::late;
    if (talk.end != End::closed) return talk;
    if ((watched[0].revents & POLLOUT) != 0 && !text.empty()) say(text);
    if ((watched[0].revents & (POLLIN | POLLHUP | POLLERR)) != 0 && !listen(talk.answer)) return talk;
    if (talk.answer.size() > most) {
      talk.end = End::too_much;
      return talk;
    }
  }
}

std::string ChildProcess::finish() {
  if (pid_ < 0) return {};
  kill(pid_, SIGKILL);  // no more than a wait where it has ended by itself
  int status = 0;
  while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  pid_ = -1;
  if (WIFSIGNALED(status))
    return fmt::format("was ended by signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)));
  if (WEXITSTATUS(status) == kNotStarted) return "could not be started";
  return fmt::format("ended with code {}", WEXITSTATUS(status));
}

}  // namespace vigil
