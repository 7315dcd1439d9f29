/// Runs of the replay presets and what a lane said in them.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/engine/runs/capture.hpp"

namespace vigil::test {

inline constexpr const char* kReplayPresets[3] = {"replay-nongaussian", "replay-ubb", "replay-mixed"};

/// A preset with these lanes only (none named: all) and a merge patch.
Scenario replay_scenario(const std::string& preset, const std::vector<std::string>& lanes = {},
                         const Json& patch = Json::object());

Json replay_case(int number);
Json no_attack();

/// A run, with all it said.
struct Told {
  Told(const Scenario& scenario, RunOptions options);

  double at(std::int64_t k, const std::string& signal) const;
  /// Of lane and node 1, or of the lane alone where it begins with truth, input or sensor.
  double of(const std::string& lane, std::int64_t k, const std::string& what) const;
  double metric(const std::string& lane, const std::string& name, const std::string& variant = "") const;
  bool has_metric(const std::string& lane, const std::string& name) const;
  std::vector<Mark> marks(MarkType type, const std::string& code = "") const;

  vigil::Run run;
  Capture capture;
};

/// The part of a JSON pointer's sentence that a refusal must have: field, value and expectation.
InputError refusal(const Scenario& scenario, const RunOptions& options = {});

}  // namespace vigil::test
