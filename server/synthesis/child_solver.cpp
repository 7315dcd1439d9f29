#include "server/synthesis/child_solver.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <exception>
#include <iostream>
#include <iterator>
#include <mutex>
#include <optional>

#include "server/synthesis/child_process.hpp"
#include "server/synthesis/dsdp_solver.hpp"

namespace vigil {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kShare = 0.9;    // of the limit, after which the child is asked to give what it has
constexpr double kLongest = 1e6;  // s
constexpr std::size_t kMostBytes = 4u << 20;

/// Whose turn it is to have a child.
struct Turn {
  std::mutex mutex;
  std::condition_variable changed;
  bool taken = false;
};

Turn& turn() {
  static Turn one;
  return one;
}

/// Taken at the end of the wait, given back at the end of the scope.
class MyTurn {
 public:
  explicit MyTurn(const std::atomic<bool>& given_up) {
    std::unique_lock lock(turn().mutex);
    turn().changed.wait(lock, [&] { return given_up || !turn().taken; });
    mine_ = !given_up;
    if (mine_) turn().taken = true;
  }
  ~MyTurn() {
    if (!mine_) return;
    const std::lock_guard lock(turn().mutex);
    turn().taken = false;
    turn().changed.notify_all();
  }
  MyTurn(const MyTurn&) = delete;
  MyTurn& operator=(const MyTurn&) = delete;

 private:
  bool mine_ = false;
};

SdpSolution without(SdpVerdict verdict, std::string detail) {
  SdpSolution solution;
  solution.verdict = verdict;
  solution.detail = std::move(detail);
  return solution;
}

/// What a child said, if it is an answer to this problem.
std::optional<SdpSolution> read_answer(const std::string& text, const SdpProblem& problem) {
  try {
    SdpSolution solution = read_sdp_solution(Json::parse(text));
    if (solution.y.size() != 0 && solution.y.size() != problem.variables()) return std::nullopt;
    if (!solution.y.allFinite()) return std::nullopt;
    return solution;
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

}  // namespace

ChildSolver::ChildSolver(std::string executable)
    : executable_(executable.empty() ? "/proc/self/exe" : std::move(executable)),
      wake_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {}

ChildSolver::~ChildSolver() {
  if (wake_ >= 0) close(wake_);
}

void ChildSolver::cancel() {
  {
    const std::lock_guard lock(turn().mutex);
    cancelled_ = true;
  }
  turn().changed.notify_all();
  if (wake_ >= 0) eventfd_write(wake_, 1);
}

SdpSolution ChildSolver::solve(const SdpProblem& problem, double limit) {
  const MyTurn mine(cancelled_);
  if (cancelled_) return without(SdpVerdict::failed, "the solve was cancelled");
  const auto begin = Clock::now();
  SdpSolution solution;
  try {
    solution = ask_child(problem, std::isfinite(limit) ? std::clamp(limit, 0.0, kLongest) : kLongest);
  } catch (const std::exception& error) {
    solution = without(SdpVerdict::failed, fmt::format("the solver's process could not be had: {}", error.what()));
  }
  solution.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  return solution;
}

SdpSolution ChildSolver::ask_child(const SdpProblem& problem, double limit) {
  const auto deadline =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(limit));
  const std::string question = Json{{"problem", to_json(problem)}, {"limit", kShare * limit}}.dump();
  ChildProcess child(executable_, "solve-sdp");
  const ChildProcess::Talk talk = child.talk(question, deadline, wake_, kMostBytes);
  switch (talk.end) {
    case ChildProcess::End::late:
      return without(SdpVerdict::timed_out, fmt::format("no answer within {} s", limit));
    case ChildProcess::End::woken:
      return without(SdpVerdict::failed, "the solve was cancelled");
    case ChildProcess::End::too_much:
      return without(SdpVerdict::failed, "the solver's process said more than any solution takes");
    case ChildProcess::End::closed:
      break;
  }
  if (auto answer = read_answer(talk.answer, problem)) return std::move(*answer);
  const std::string end = child.finish();
  if (talk.answer.empty()) return without(SdpVerdict::failed, "the solver's process " + end + " without an answer");
  return without(SdpVerdict::failed, "the solver's process " + end + " and said what is no solution");
}

int solve_for_parent() {
  const std::string text(std::istreambuf_iterator<char>(std::cin), {});
  const Json question = Json::parse(text, nullptr, false);
  if (!question.is_object() || !question.contains("problem") || !question.contains("limit")) {
    std::cerr << "vigil: solve-sdp is for the server's own use\n";
    return 2;
  }
  // Whatever the library prints must not end up in the answer.
  const int channel = dup(STDOUT_FILENO), nowhere = open("/dev/null", O_WRONLY);
  dup2(nowhere, STDOUT_FILENO);
  DsdpSolver solver;
  const SdpSolution solution = solver.solve(read_sdp(question.at("problem")), question.at("limit").get<double>());
  const std::string answer = to_json(solution).dump();
  std::string_view rest = answer;
  while (!rest.empty()) {
    const ssize_t written = write(channel, rest.data(), rest.size());
    if (written <= 0) return 1;
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

}  // namespace vigil
