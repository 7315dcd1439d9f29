/// What someone might have measured, to be pushed into a run.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "engine/run/frame_csv.hpp"
#include "engine/run/pushed_columns.hpp"
#include "tests/engine/runs/capture.hpp"

namespace vigil::api_test {

/// Readings and truth of a simulated run of `consensus`, as someone might measure them.
struct Measured {
  std::vector<std::string> names;
  std::vector<int> node;  ///< by column, -1: truth
  std::vector<std::string> nodes;
  std::vector<std::vector<double>> cells;  ///< tick, column

  explicit Measured(std::uint64_t seed) {
    const Scenario scenario = Scenario::preset("consensus");
    PushedColumns columns = pushed_columns(scenario);
    names = columns.names;
    node = columns.reporter;
    nodes = columns.nodes;
    vigil::Run run(scenario, {seed, nullptr, {}});
    vigil::test::Capture capture;
    vigil::test::run_to_end(run, capture);
    for (const Frame& frame : capture.frames) {
      cells.emplace_back();
      for (const std::string& name : names)
        cells.back().push_back(frame.values[static_cast<std::size_t>(run.catalogue().find(name))]);
    }
  }

  std::string csv(std::size_t from, std::size_t to) const {
    Catalogue header;
    for (const std::string& name : names) header.add({.name = name});
    std::string text = csv_header(header);
    for (std::size_t k = from; k < to; ++k)
      append_csv_row(text, {static_cast<std::int64_t>(k), static_cast<double>(k), cells[k]});
    return text;
  }

  /// What one node (-1: who knows the truth) says of tick k.
  Json line(std::size_t k, int who) const {
    Json row{{"seq", k}, {"k", k}, {"values", Json::object()}};
    const std::string id = who < 0 ? "" : nodes[static_cast<std::size_t>(who)];
    if (who >= 0) row["node"] = id;
    for (std::size_t c = 0; c < names.size(); ++c) {
      if (node[c] != who) continue;
      const double value = cells[k][c];
      row["values"][who < 0 ? names[c] : names[c].substr(8 + id.size())] =
          std::isfinite(value) ? Json(value) : Json(nullptr);
    }
    return row;
  }
};

}  // namespace vigil::api_test
