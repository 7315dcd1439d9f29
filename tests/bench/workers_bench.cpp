// Campaigns by three workers over a NATS broker, against the threads of one process: what handing out costs; and what a
// slow trial gains by more workers.
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "engine/core/json.hpp"

namespace {

using vigil::Json;
using Words = std::vector<std::string>;

constexpr const char* kPort = "24299";
constexpr int kRounds = 3;

/// Killed when it goes.
class Process {
 public:
  Process(Words words, const std::string& output) {
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    pid_ = fork();
    if (pid_ != 0) return;
    const int file = open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    dup2(file, STDOUT_FILENO);
    dup2(open("/dev/null", O_WRONLY), STDERR_FILENO);
    execvp(argv[0], argv.data());
    _exit(126);
  }
  Process(Process&& other) noexcept : pid_(std::exchange(other.pid_, -1)) {}
  ~Process() {
    if (pid_ < 0) return;
    kill(pid_, SIGKILL);
    wait();
  }
  int wait() {
    int status = 0;
    waitpid(std::exchange(pid_, -1), &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  pid_t pid_ = -1;
};

class Bench {
 public:
  Bench() : folder_(std::filesystem::temp_directory_path() / ("vigil-workers-" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
    broker_.emplace_back(Words{"nats-server", "-a", "127.0.0.1", "-p", kPort, "-js", "-sd", folder_ / "store"},
                         folder_ / "broker.log");
    std::this_thread::sleep_for(std::chrono::seconds(1));
  }
  ~Bench() {
    workers_.clear();
    broker_.clear();
    std::error_code error;
    std::filesystem::remove_all(folder_, error);
  }
  void hire(int workers) {
    workers_.clear();
    for (int i = 0; i < workers; ++i)
      workers_.emplace_back(Words{VIGIL_EXECUTABLE, "worker", "--nats", url(), "--threads", "1"},
                            folder_ / "worker.log");
    std::this_thread::sleep_for(std::chrono::seconds(1));
  }
  /// Trials a second, from the command's own clock.
  double rate(const std::string& preset, int runs, const Words& crew) {
    const std::string output = folder_ / "result.json";
    Words words{VIGIL_EXECUTABLE, "campaign", preset, "--runs", std::to_string(runs), "--json", "-"};
    words.insert(words.end(), crew.begin(), crew.end());
    if (Process(words, output).wait() != 0) throw std::runtime_error("the campaign failed; is nats-server installed?");
    std::ostringstream text;
    text << std::ifstream(output).rdbuf();
    return runs / Json::parse(text.str())["timing"]["run"]["seconds"].get<double>();
  }
  static std::string url() { return std::string("nats://127.0.0.1:") + kPort; }

 private:
  std::filesystem::path folder_;
  std::vector<Process> broker_, workers_;
};

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

void compare(Bench& bench, const std::string& preset, int runs) {
  const std::string cores = std::to_string(std::max(1U, std::thread::hardware_concurrency()));
  std::vector<double> threads, workers, ratios;
  for (int round = 0; round < kRounds; ++round) {
    threads.push_back(bench.rate(preset, runs, {"--threads", cores}));
    workers.push_back(bench.rate(preset, runs, {"--nats", Bench::url()}));
    ratios.push_back(workers.back() / threads.back());
  }
  std::printf("%-20s %s threads %8.1f trials/s   3 workers %8.1f trials/s   ratio %.2f\n", preset.c_str(),
              cores.c_str(), median(threads), median(workers), median(ratios));
  std::fflush(stdout);
}

}  // namespace

int main() {
  Bench bench;
  bench.hire(3);
  compare(bench, "consensus", 3000);
  compare(bench, "replay-nongaussian", 1000);
  compare(bench, "sparse", 40);
  setenv("VIGIL_TRIAL_SLEEP_MS", "50", 1);
  double one = 0;
  for (const int workers : {1, 2, 3}) {
    bench.hire(workers);
    const double rate = bench.rate("consensus", 200, {"--nats", Bench::url()});
    if (workers == 1) one = rate;
    std::printf("a trial of 50 ms more: %d workers %6.1f trials/s, %.2f of one\n", workers, rate, rate / one);
    std::fflush(stdout);
  }
}
