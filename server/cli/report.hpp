/// Results as a person reads them.
#pragma once

#include <string>
#include <vector>

#include "engine/run/campaign.hpp"
#include "engine/run/run.hpp"

namespace vigil {

/// Rows of cells, each column as wide as its widest; the first column to the left, the others to the right.
std::string aligned(const std::vector<std::vector<std::string>>& rows);
/// Six significant digits; "-" where there is none.
std::string six_digits(double value);
/// Network metrics: one row a lane, one column a metric.
std::string metric_table(const std::vector<MetricValue>& metrics);
/// The same for a campaign: mean +- standard error.
std::string summary_table(const std::vector<MetricSummary>& metrics);
/// One line a lane and code: how often, on how many nodes, from when to when.
std::string fault_lines(const std::vector<FaultCount>& faults);
/// True when a fault stopped a lane.
bool any_stopped(const std::vector<FaultCount>& faults);

}  // namespace vigil
