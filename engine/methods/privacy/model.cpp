#include "engine/methods/privacy/model.hpp"

#include <cmath>

namespace vigil::privacy {
namespace {

using Eigen::MatrixXd;

MatrixXd matrix(std::initializer_list<std::initializer_list<double>> rows) { return MatrixXd(rows); }
MatrixXd diagonal(std::initializer_list<double> entries) {
  MatrixXd D = MatrixXd::Zero(static_cast<Eigen::Index>(entries.size()), static_cast<Eigen::Index>(entries.size()));
  Eigen::Index at = 0;
  for (const double entry : entries) D(at, at) = entry, ++at;
  return D;
}

constexpr double kStraight = 1e-9;  // rad/s; a slower turn is none

}  // namespace

FusionModel linear_robot(double step) {
  return {
      .A = matrix({{1, step}, {0, 1}}),
      .B = matrix({{step * step / 2}, {step}}),
      .Q = matrix({{1}}),
      .sensors = {{matrix({{1, 0}, {0, 1}}), diagonal({0.9, 0.5})}, {matrix({{0, 1}, {1, 0}}), diagonal({0.7, 0.8})}},
      .x0 = Eigen::Vector2d(0, 1),
      .P0 = diagonal({0.1, 0.1})};
}

FusionModel turning_target(double rate, double step) {
  const double s = std::sin(rate * step), c = std::cos(rate * step);
  const bool straight = std::abs(rate) < kStraight;
  const double along = straight ? step : s / rate, across = straight ? 0 : (1 - c) / rate;
  return {.A = straight ? matrix({{1, step, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, step}, {0, 0, 0, 1}})
                        : matrix({{1, along, 0, -across}, {0, c, 0, -s}, {0, across, 1, along}, {0, s, 0, c}}),
          .B = MatrixXd::Identity(4, 4),
          .Q = diagonal({0.04, 0.01, 0.04, 0.01}),
          .sensors = {{matrix({{0.8, 0.5, 0, 0}, {0, 0, 0.6, 0.4}, {0.4, 0, 0.2, 0}}), diagonal({0.01, 0.04, 0.02})},
                      {matrix({{0, 0, 0.7, 0.3}, {0.6, 0.2, 0, 0}, {0, 0.3, 0, 0.8}}), diagonal({0.03, 0.02, 0.01})}},
          .x0 = Eigen::Vector4d(10, 1, 10, 0),
          .P0 = {}};
}

FusionModel engine_model() {
  return {.A = matrix({{0.87, 0, 0.20}, {0.03, 0.98, -0.03}, {0.03, 0, 0.80}}),
          .B = matrix({{0.1, 0}, {0.5, 0}, {-0.2, 0}}),
          .Q = diagonal({0.04, 0.01}),
          .sensors = {{matrix({{1, 1, 0}}), matrix({{0.06}})}, {matrix({{0, 1, -1}}), matrix({{0.02}})}},
          .x0 = Eigen::Vector3d::Zero(),
          .P0 = {}};
}

MatrixXd stack(int n, int count) { return MatrixXd::Identity(n, n).replicate(count, 1); }

MatrixXd block_diagonal(const std::vector<MatrixXd>& blocks) {
  Eigen::Index rows = 0, columns = 0;
  for (const MatrixXd& block : blocks) rows += block.rows(), columns += block.cols();
  MatrixXd whole = MatrixXd::Zero(rows, columns);
  rows = columns = 0;
  for (const MatrixXd& block : blocks) {
    whole.block(rows, columns, block.rows(), block.cols()) = block;
    rows += block.rows(), columns += block.cols();
  }
  return whole;
}

MatrixXd column_of(const std::vector<MatrixXd>& blocks) {
  Eigen::Index rows = 0;
  for (const MatrixXd& block : blocks) rows += block.rows();
  MatrixXd whole(rows, blocks.empty() ? 0 : blocks.front().cols());
  rows = 0;
  for (const MatrixXd& block : blocks) {
    whole.middleRows(rows, block.rows()) = block;
    rows += block.rows();
  }
  return whole;
}

}  // namespace vigil::privacy
