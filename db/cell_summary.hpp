/// The metrics of one point of a campaign and little else, small enough to be read for every point at once.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/json.hpp"

namespace vigil {

/// What a metric's figures are called, in order.
inline constexpr std::array<const char*, 10> kSummaryFigures{"mean", "se",   "median", "min",  "max",
                                                             "0.05", "0.25", "0.75",   "0.95", "n"};

struct CellSummary {
  struct Row {
    std::string lane, node, name, variant;
    std::array<double, kSummaryFigures.size()> figures{};  ///< by kSummaryFigures; NaN: there is none
  };
  Json trials = Json::object();  ///< {"finished","stopped","failed"}
  std::int64_t ticks = 0;
  Json warnings = Json::array();
  std::vector<Row> rows;
};

/// Of a cell's whole result; what it lacks is left out.
CellSummary cell_summary(const Json& result);
std::string encode(const CellSummary& summary);
/// Throws std::runtime_error where the bytes are damaged.
CellSummary decode_summary(std::string_view bytes);

}  // namespace vigil
