/// Section 13 of the specification of seed 001: x mean square errors of nodes 1 to 5, and what it takes to compare.
#pragma once

#include <array>

#include "tests/engine/campaign/section12.hpp"

namespace vigil::section13 {

using section12::expect_agrees;
using section12::Figure;
using section12::only;
using section12::Results;
using section12::runs;

inline const char* const kNodes[] = {"1", "2", "3", "4", "5"};

/// A lane of the preset by itself, in a document that may be patched.
inline Scenario lone(const std::string& lane, const Json& patch = Json::object()) {
  return only(Scenario::preset("sparse"), {lane}).patched(patch);
}

inline Json lane_params(const char* lane, const Json& params) { return {{"lanes", {{lane, {{"params", params}}}}}}; }

/// One row of the table. `errors` are its printed standard errors; a printed zero is the rounding of its last digit.
struct Row {
  const char* what;
  const char* lane;
  Json patch;
  std::array<double, 5> means, errors;
  int quick;  ///< runs of the reduced statistics
};

/// The table's row where a second implementation gave better means from more runs: its errors shrink with them.
inline Row of_more_runs(Row row, const std::array<double, 5>& means, double runs, double more_runs) {
  row.means = means;
  for (double& error : row.errors) error *= std::sqrt(runs / more_runs);
  return row;
}

inline Figure cell(const Row& row, std::size_t node) {
  constexpr double kRounded = 5e-5;
  return {row.means[node], row.errors[node] > 0 ? row.errors[node] : kRounded};
}

inline bool agrees(const MetricSummary& summary, const Figure& expected) {
  return std::abs(summary.mean - expected.value) <= 4 * std::hypot(summary.se, expected.error);
}

}  // namespace vigil::section13
