/// The scenario that an identified model is written as.
#include <fmt/format.h>

#include "engine/identify/identify.hpp"

namespace vigil::identify {
namespace {

Json rows_of(const Eigen::MatrixXd& matrix) {
  Json rows = Json::array();
  for (Eigen::Index r = 0; r < matrix.rows(); ++r) {
    Json row = Json::array();
    for (Eigen::Index c = 0; c < matrix.cols(); ++c) row.push_back(matrix(r, c));
    rows.push_back(std::move(row));
  }
  return rows;
}

Json numbers(const Eigen::VectorXd& vector) {
  Json list = Json::array();
  for (const double value : vector) list.push_back(value);
  return list;
}

/// One filter over all outputs and one at each, under every detector.
Json lanes(int window) {
  const Json windowed{{"window", window}};
  Json all = Json::object();
  for (const auto& [prefix, method] : {std::pair{"all", "centralized_ekf"}, std::pair{"each", "local_ekf"}}) {
    for (const std::string_view type : {"chi_square", "cusum", "fixed", "dynamic"}) {
      const bool energy = type == "fixed" || type == "dynamic";
      all[fmt::format("{}_{}", prefix, type)] = {
          {"method", method}, {"detector", {{"type", type}, {"params", energy ? windowed : Json::object()}}}};
    }
  }
  return all;
}

}  // namespace

Json scenario_of(const Identified& identified, const Task& task) {
  const StateSpace& space = identified.space;
  Json nodes = Json::object(), estimates = Json::object();
  for (std::size_t i = 0; i < identified.nodes.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    nodes[identified.nodes[i]] = {
        {"sensor", {{"type", "linear"}, {"params", {{"C", rows_of(space.C.row(row))}, {"R", space.R[row]}}}}}};
    estimates[identified.nodes[i]] = numbers(space.mean);
  }
  return {{"vigil", 1},
          {"id", task.id},
          {"title", {{"en", "Identified from " + task.source}, {"zh", "由 " + task.source + " 辨识得到"}}},
          {"source", task.source},
          {"family", "replay"},
          {"time", {{"dt", task.dt}, {"steps", nullptr}}},
          {"plant", {{"type", "linear"}, {"params", {{"A", rows_of(space.A)}, {"B", rows_of(space.B)}}}}},
          {"nodes", nodes},
          {"noise", {{"Q", rows_of(space.Q)}, {"P0", rows_of(space.P0)}}},
          {"initial", {{"estimates", estimates}}},
          {"lanes", lanes(task.window)},
          {"view", {{"detector", true}, {"lane", "all_fixed"}, {"mapping", to_json(identified.mapping)}}}};
}

}  // namespace vigil::identify
