/// CPU time of 100 runs of the scenarios of seed 004, one thread, and of one tick of one lane beside the bounds of the
/// specification (privacy), section 8.
#include <algorithm>
#include <array>
#include <cstdio>
#include <string>

#include "engine/run/campaign.hpp"
#include "tests/bench/lane_times.hpp"

namespace vigil::bench {
namespace {

constexpr int kRuns = 100;

double hundred_runs(const Scenario& scenario) {
  const double before = cpu_milliseconds();
  CampaignTable table;
  for (int i = 1; i <= kRuns; ++i) table.add(run_trial(scenario, static_cast<std::uint64_t>(i)));
  return cpu_milliseconds() - before;
}

void print(const std::string& id, const char* aim) {
  const Scenario scenario = Scenario::preset(id);
  std::array<double, 5> times{};
  for (double& time : times) time = hundred_runs(scenario);
  std::sort(times.begin(), times.end());
  const Json& document = scenario.document();
  const double ticks = kRuns * document["time"]["steps"].get<double>() * static_cast<double>(document["lanes"].size());
  std::printf("%-24s 100 runs %7.3f s of CPU (median %.3f), %6.2f us a lane and tick%s\n", id.c_str(),
              times.front() / 1e3, times[2] / 1e3, 1e3 * times.front() / ticks, aim);
}

}  // namespace
}  // namespace vigil::bench

int main() {
  using vigil::bench::print;
  print("privacy-engine", "  (aim 2 s)");
  print("privacy-robot-linear", "  (aim 50 us)");
  print("privacy-robot-nonlinear", "  (aim 200 us)");
  print("privacy-turn", "  (aim 50 us)");
  return 0;
}
