// Runs of the scenarios of seed 004, their signals by name.
#pragma once

#include "tests/engine/runs/capture.hpp"

namespace vigil::test {

struct Told004 {
  explicit Told004(const Scenario& scenario, std::uint64_t seed = 1, std::shared_ptr<const Trace> trace = nullptr);
  /// A signal's value at a tick; fails where there is no such signal.
  double at(const std::string& signal, int k) const;

  vigil::Run run;
  Capture capture;
};

Scenario privacy(const std::string& which, const Json& patch = Json::object());

}  // namespace vigil::test
