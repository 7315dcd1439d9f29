#include "engine/methods/privacy/mechanism_params.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace vigil::privacy {

Param epsilon_param() {
  return {.name = "epsilon",
          .fallback = std::log(2.0),
          .minimum = 0,
          .maximum = 1e6,
          .exclusive_minimum = true,
          .symbol = "ε",
          .meaning = {"Privacy loss that is allowed", "允许的隐私损失"}};
}

Param delta_param() {
  return {.name = "delta",
          .fallback = 0.1,
          .minimum = 0,
          .maximum = 0.5,
          .exclusive_minimum = true,
          .exclusive_maximum = true,
          .symbol = "δ",
          .meaning = {"Probability with which the loss may be larger", "隐私损失超出的允许概率"}};
}

Param adjacent_param() {
  return {.name = "H",
          .type = ParamType::vector,
          .nullable = true,
          .symbol = "H",
          .meaning = {"Components in which adjacent trajectories may differ, 0 or 1 each; null: all",
                      "相邻轨迹允许不同的分量（每个为 0 或 1）；null 表示全部"}};
}

Eigen::VectorXd read_adjacent(const Params& params, int n) {
  if (!params.given("H")) return Eigen::VectorXd::Ones(n);
  const Eigen::VectorXd H = params.vector("H");
  if (H.size() != n || (H.array() * (1 - H.array()) != 0).any())
    throw InputError("/H", fmt::format("H must have {} entries, each 0 or 1", n), "0 or 1");
  return H;
}

ParamTable dp_table(std::vector<Param> own) {
  std::vector<Param> all{epsilon_param(),
                         delta_param(),
                         {.name = "lambda",
                          .fallback = 1.0,
                          .minimum = 0,
                          .maximum = 1e9,
                          .symbol = "λ",
                          .meaning = {"How far apart adjacent states may be (2-norm)", "相邻状态的最大距离（二范数）"}},
                         {.name = "kappa",
                          .type = ParamType::integer,
                          .fallback = 10,
                          .minimum = 1,
                          .maximum = 1000,
                          .symbol = "κ",
                          .meaning = {"Fused estimates in a published mean", "发布均值所含的融合估计个数"}},
                         adjacent_param()};
  all.insert(all.end(), own.begin(), own.end());
  return {std::move(all)};
}

DpSettings read_dp_settings(const Params& params, int n) {
  return {.epsilon = params.real("epsilon"),
          .delta = params.real("delta"),
          .lambda = params.real("lambda"),
          .kappa = params.integer("kappa"),
          .H = read_adjacent(params, n),
          .shares = {},
          .at_centre = false};
}

bool stationary(const PublicTick& tick, const StationaryFilters& filters) {
  return (tick.P - filters.P).norm() <= 1e-9 * filters.P.norm();
}

void add_releases(Json& design, const std::string& node, const Plant& plant, const Eigen::VectorXd& std,
                  const Eigen::VectorXd& shift) {
  for (Eigen::Index c = 0; c < shift.size(); ++c)
    design["releases"].push_back({{"node", node},
                                  {"component", plant.state()[static_cast<std::size_t>(c)].name},
                                  {"std", std[c]},
                                  {"shift", std::abs(shift[c])}});
}

void add_distance(Json& design, const std::string& node, double std, const Eigen::VectorXd& shift) {
  design["releases"].push_back({{"node", node}, {"component", "‖·‖"}, {"std", std}, {"shift", shift.norm()}});
}

Json matrix_json(const Eigen::MatrixXd& matrix) {
  Json rows = Json::array();
  for (Eigen::Index r = 0; r < matrix.rows(); ++r) {
    Json row = Json::array();
    for (Eigen::Index c = 0; c < matrix.cols(); ++c) row.push_back(matrix(r, c));
    rows.push_back(row);
  }
  return rows;
}

}  // namespace vigil::privacy
