/// The paper's examples as data. Specification (observer), section 8.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "engine/world/interconnected/network.hpp"
#include "engine/world/interconnected/signals.hpp"

namespace vigil::observer {

struct Example {
  Network network;
  std::vector<Eigen::VectorXd> x0;
  std::vector<SubsystemSignals> signals;
  double horizon = 0;  ///< s
  double dt = 1e-3;    ///< s, a tick
};

/// Example 3.1, two subsystems. Section 8.1.
Example pair();

enum class AreaOutputs { case_1, case_2 };  ///< of areas 2 and 4; case 2 breaks the matching condition
enum class Topology { full, ring };
/// Comparison 1, four areas. Section 8.2. attack_area_2: w2 = sin t, else 0.
Example areas(AreaOutputs outputs, Topology topology = Topology::full, bool attack_area_2 = false);

/// Comparison 2: subsystem 2 of the pair alone. Section 8.3.
Example single();

/// k (even, or 1) subsystems of the pair in turn, each coupled with its two neighbours (k = 2: one). Section 6, the
/// cost table. No signals.
Network ring(int k);

}  // namespace vigil::observer
