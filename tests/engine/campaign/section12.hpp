/// The tables of section 12 of the specification and what it takes to compare a campaign with them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "engine/run/campaign.hpp"

namespace vigil::section12 {

/// VIGIL_FULL set: the whole tables; else reduced statistics, with the bounds that belong to them.
inline bool full() { return std::getenv("VIGIL_FULL") != nullptr; }
inline int runs(int quick, int whole) { return full() ? whole : quick; }

struct Figure {
  double value = 0, error = 0;
};

/// Summaries of one campaign by lane, name, node and variant.
class Results {
 public:
  Results(const Scenario& scenario, int trials, std::uint64_t first_seed = 1);

  const MetricSummary& row(const std::string& lane, const std::string& name, const std::string& node = "",
                           const std::string& variant = "") const;
  double mean(const std::string& lane, const std::string& name = "rmse_position", const std::string& node = "") const;
  double error(const std::string& lane, const std::string& name = "rmse_position", const std::string& node = "") const;
  int stopped() const { return stopped_; }  ///< faults that stopped a lane

 private:
  std::map<std::string, MetricSummary> rows_;
  int stopped_ = 0;
};

/// Within four combined standard errors; a figure printed without one has the error of the runs it was made from.
void expect_agrees(const MetricSummary& row, const Figure& expected, const std::string& what);

/// A scenario with some lanes only: a lane's draws do not depend on the others.
Scenario only(const Scenario& scenario, const std::vector<std::string>& lanes);

}  // namespace vigil::section12
