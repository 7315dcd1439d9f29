/// CPU time of one run of ten seconds (200 ticks, five nodes, set-up and scores included) of preset `sparse`, each lane
/// alone: least and median of eleven seeds. The world, the attacks and the scores are in each; `pred` shows what they
/// take.
#include <algorithm>
#include <array>
#include <cstdio>
#include <ctime>
#include <map>
#include <string>

#include "engine/run/campaign.hpp"

namespace {

constexpr int kSeeds = 11;

const std::map<std::string, double> kAims{{"omp_game", 50}, {"l1", 1000}, {"etpg", 1000}};  // ms

double cpu_milliseconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

vigil::Scenario alone(const vigil::Scenario& preset, const std::string& lane) {
  vigil::Json lanes = vigil::Json::object();
  for (const auto& [other, ignored] : preset.document()["lanes"].items()) lanes[other] = {{"enabled", other == lane}};
  return preset.patched({{"lanes", lanes}});
}

/// False where a lane had to be stopped: its time would mean nothing.
bool measure(const std::string& name, const vigil::Scenario& scenario) {
  std::array<double, kSeeds> times{};
  vigil::run_trial(scenario, 1);  // what is read and set up once
  for (int seed = 0; seed < kSeeds; ++seed) {
    const double before = cpu_milliseconds();
    const vigil::TrialResult trial = vigil::run_trial(scenario, static_cast<std::uint64_t>(seed + 1));
    times[static_cast<std::size_t>(seed)] = cpu_milliseconds() - before;
    const auto stopped = [](const vigil::FaultCount& fault) { return fault.stopped; };
    if (std::any_of(trial.faults.begin(), trial.faults.end(), stopped)) return false;
  }
  std::sort(times.begin(), times.end());
  std::printf("sparse  %-18s %7.2f ms a run (median %.2f)", name.c_str(), times.front(), times[kSeeds / 2]);
  const auto aim = kAims.find(name);
  if (aim != kAims.end()) std::printf("  (aim %.0f ms)", aim->second);
  std::printf("\n");
  return true;
}

}  // namespace

int main() {
  const vigil::Scenario preset = vigil::Scenario::preset("sparse");
  bool sound = true;
  for (const auto& [lane, ignored] : preset.document()["lanes"].items()) {
    sound = measure(lane, alone(preset, lane)) && sound;
  }
  sound = measure("all lanes", preset) && sound;
  if (!sound) std::fprintf(stderr, "a lane stopped: its time would mean nothing\n");
  return sound ? 0 : 1;
}
