/// A whole campaign out of its cells' results.
#pragma once

#include <vector>

#include "engine/core/json.hpp"
#include "server/campaigns/request.hpp"

namespace vigil {

/// A cell's result (CampaignCell::result()) and what it is set to. A null result: no trial yet.
struct CellResult {
  std::int64_t cell = 0;
  Json sweep;
  Json result;
};

/// The rows of `key` ("metrics", "paired", "detection", "faults") of every cell, each with its "sweep".
Json rows_of(const std::vector<CellResult>& cells, const char* key);
/// [{"sweep","design"},…], or the design itself where there is one cell.
Json designs_of(const std::vector<CellResult>& cells);
/// Each once.
Json warnings_of(const std::vector<CellResult>& cells);
/// {"finished","stopped","failed"} over all cells.
Json trials_of(const std::vector<CellResult>& cells);
/// Rows of "metrics" and of "faults" as what they were made of, as far as a table needs it.
std::vector<MetricSummary> summaries_of(const Json& metrics);
std::vector<FaultCount> faults_of(const Json& faults);
/// One row a cell and metric: cell, a column for each path of the sweep, lane, node, name, variant, the statistics.
std::string results_csv(const std::vector<CellResult>& cells);

}  // namespace vigil
