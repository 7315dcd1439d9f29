/// Networks for the tests: three subsystems of different sizes and one direction each, and what a lane scores.
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "engine/methods/observer/printed_gains.hpp"
#include "engine/world/interconnected/examples.hpp"
#include "tests/engine/linalg/random_matrices.hpp"
#include "tests/engine/methods/observer/network_simulation.hpp"

namespace vigil::observer {

struct Sizes {
  int n, m, p, q, dd, g, r;
};

Subsystem random_subsystem(RandomMatrices& random, const Sizes& sizes);

/// n 3, 2, 4; two attacks, none, one; a fault, none, none; 1 -> 2 -> 3 -> 1 and no way back.
Network mixed(int number);

/// Root mean squares over the ticks in (from, to], for one subsystem.
struct Score {
  double w = 0, f = 0;   ///< errors of all entries together
  double x = 0;          ///< the largest component's
  double signal_w = 0;   ///< of w itself
  double largest_w = 0;  ///< largest |error|
};

using Watch = std::function<void(double t, int subsystem, const Snapshot&)>;

/// Runs a lane over an example's horizon and calls `watch` at every tick. False where it diverges.
bool run_lane(NetworkSimulation simulation, const Example& example, const Watch& watch, int finer = 1);

std::vector<Score> score(const NetworkSimulation& simulation, const Example& example, double from, double to);

/// The largest difference of any estimate between two lanes of the same plant, and of any error where they differ in
/// it.
struct Difference {
  double estimates = 0;
  double errors = 0;
};
Difference difference(const NetworkSimulation& a, const Example& of_a, const NetworkSimulation& b, const Example& of_b);

}  // namespace vigil::observer
