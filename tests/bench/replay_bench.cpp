/// CPU time of one closed-loop run of 300 ticks of the replay presets: each lane alone, with its plant, its attack-free
/// twin, gains and scores, then all lanes together.
#include "tests/bench/lane_times.hpp"

int main() {
  constexpr double kLane = 5, kAll = 50;  // ms
  bool sound = true;
  for (const char* id : {"replay-mixed", "replay-nongaussian", "replay-ubb"}) {
    const vigil::Scenario preset = vigil::Scenario::preset(id);
    vigil::bench::Aims aims{{"all lanes", kAll}};
    for (const auto& [lane, document] : preset.document()["lanes"].items()) {
      if (document["method"] == "mixed_filter") aims[lane] = kLane;
    }
    sound = vigil::bench::print_times(preset, aims) && sound;
  }
  return sound ? 0 : 1;
}
