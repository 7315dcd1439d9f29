/// CPU time of whole runs (set-up and scores included) of a preset, lane by lane and all lanes together: least and
/// median of eleven seeds.
#pragma once

#include <algorithm>
#include <array>
#include <cstdio>
#include <ctime>
#include <map>
#include <string>

#include "engine/run/campaign.hpp"

namespace vigil::bench {

/// Milliseconds by lane; "all lanes" of them together. Lanes without one have none.
using Aims = std::map<std::string, double>;

inline double cpu_milliseconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

inline Scenario alone(const Scenario& preset, const std::string& lane) {
  Json lanes = Json::object();
  for (const auto& [other, ignored] : preset.document()["lanes"].items()) lanes[other] = {{"enabled", other == lane}};
  return preset.patched({{"lanes", lanes}});
}

/// False where a lane had to be stopped: its time would mean nothing.
inline bool print_time(const std::string& name, const Scenario& scenario, const Aims& aims) {
  constexpr int kSeeds = 11;
  std::array<double, kSeeds> times{};
  run_trial(scenario, 1);  // what is read and set up once
  for (int seed = 0; seed < kSeeds; ++seed) {
    const double before = cpu_milliseconds();
    const TrialResult trial = run_trial(scenario, static_cast<std::uint64_t>(seed + 1));
    times[static_cast<std::size_t>(seed)] = cpu_milliseconds() - before;
    const auto stopped = [](const FaultCount& fault) { return fault.stopped; };
    if (std::any_of(trial.faults.begin(), trial.faults.end(), stopped)) return false;
  }
  std::sort(times.begin(), times.end());
  std::printf("%-18s %-18s %7.2f ms a run (median %.2f)", scenario.id().c_str(), name.c_str(), times.front(),
              times[kSeeds / 2]);
  const auto aim = aims.find(name);
  if (aim != aims.end()) std::printf("  (aim %.0f ms)", aim->second);
  std::printf("\n");
  return true;
}

/// Every lane of a preset alone, then all. False, with a sentence, where a lane stopped.
inline bool print_times(const Scenario& preset, const Aims& aims) {
  bool sound = true;
  for (const auto& [lane, ignored] : preset.document()["lanes"].items())
    sound = print_time(lane, alone(preset, lane), aims) && sound;
  sound = print_time("all lanes", preset, aims) && sound;
  if (!sound) std::fprintf(stderr, "a lane stopped: its time would mean nothing\n");
  return sound;
}

}  // namespace vigil::bench
