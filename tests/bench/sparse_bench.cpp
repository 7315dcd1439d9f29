/// CPU time of one run of ten seconds (200 ticks, five nodes) of preset `sparse`: each lane alone, then all lanes. The
/// world, the attacks and the scores are in each; `pred` shows what they take.
#include "tests/bench/lane_times.hpp"

int main() {
  const vigil::bench::Aims aims{{"omp_game", 50}, {"l1", 1000}, {"etpg", 1000}};  // ms
  return vigil::bench::print_times(vigil::Scenario::preset("sparse"), aims) ? 0 : 1;
}
