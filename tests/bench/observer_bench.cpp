/// CPU time of synthesis for rings of 2, 4 and 8 subsystems by the preset `ref`, and of a 20 s run of preset
/// `observer-pair`, lane by lane, gains solved before.
#include <chrono>

#include "engine/methods/observer/design.hpp"
#include "engine/run/design.hpp"
#include "engine/world/interconnected/examples.hpp"
#include "server/synthesis/dsdp_solver.hpp"
#include "tests/bench/lane_times.hpp"

namespace vigil::bench {
namespace {

constexpr double kLimit = 120;  // s, of a solve

class Nothing final : public Sink {
  void frame(const Frame& /*frame*/) override {}
  void mark(const Mark& /*mark*/) override {}
};

/// CPU time of the whole process: the solver's LAPACK may have threads of its own.
double process_milliseconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

bool print_ring(int k, const char* aim) {
  const observer::ErrorSystem system = observer::error_system(observer::ring(k));
  DsdpSolver solver;
  const double before = process_milliseconds();
  const observer::DesignResult result = observer::synthesise(system, observer::ref(), solver, kLimit);
  const double spent = process_milliseconds() - before;
  if (!result.certificate.holds) {
    std::fprintf(stderr, "ring of %d: %s\n", k, result.certificate.reason.c_str());
    return false;
  }
  std::printf("ring of %-2d  ref   %8.3f s of CPU, objective %.5g, certificate holds%s\n", k, spent / 1e3,
              result.design->objective, aim);
  return true;
}

bool print_lane(const std::string& lane, const Scenario& scenario) {
  DsdpSolver solver;
  Json designs = Json::object();
  for (const DesignTask& task : design_tasks(scenario)) designs[task.lane] = task.solve(solver, kLimit);
  std::array<double, 5> times{};
  for (double& time : times) {
    const double before = cpu_milliseconds();
    Run run(scenario, {.designs = designs});
    Nothing sink;
    while (!run.done()) run.step(sink);
    time = cpu_milliseconds() - before;
    if (!run.faults().empty()) return false;
  }
  std::sort(times.begin(), times.end());
  std::printf("%-18s %-22s %7.1f ms a run (median %.1f)  (aim 300 ms a lane)\n", scenario.id().c_str(), lane.c_str(),
              times.front(), times[times.size() / 2]);
  return true;
}

}  // namespace
}  // namespace vigil::bench

int main() {
  using namespace vigil;
  using namespace vigil::bench;
  bool sound = print_ring(2, "") && print_ring(4, "") && print_ring(8, "  (aim 10 s)");
  const Scenario pair = Scenario::preset("observer-pair");
  for (const auto& [lane, ignored] : pair.document()["lanes"].items())
    sound = print_lane(lane, alone(pair, lane)) && sound;
  sound = print_lane("all lanes", pair) && sound;
  return sound ? 0 : 1;
}
