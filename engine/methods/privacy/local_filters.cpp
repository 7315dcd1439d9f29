#include "engine/methods/privacy/local_filters.hpp"

#include <Eigen/Cholesky>

#include "engine/linalg/riccati.hpp"
#include "engine/linalg/small.hpp"

namespace vigil::privacy {
namespace {

using Eigen::MatrixXd;

constexpr int kDoublings = 60;
constexpr double kDoubled = 1e-15;  // relative change that ends the doubling

MatrixXd own_noise(const LocalGains& gains, const MatrixXd& R) { return gains.K * R * gains.K.transpose(); }

}  // namespace

std::optional<LocalGains> local_gains(const MatrixXd& Pz, const MatrixXd& C, const MatrixXd& R) {
  const Eigen::LLT<MatrixXd> S(C * Pz * C.transpose() + R);
  if (S.info() != Eigen::Success) return std::nullopt;
  LocalGains gains{.K = S.solve(C * Pz).transpose(), .F = {}};
  gains.F = MatrixXd::Identity(Pz.rows(), Pz.rows()) - gains.K * C;
  return gains;
}

std::vector<LocalStep> local_steps(const FusionModel& model) {
  std::vector<LocalStep> steps;
  for (const SensorModel& sensor : model.sensors) steps.push_back({model.A, sensor.C, sensor.R});
  return steps;
}

MatrixXd common_start(const MatrixXd& P0, int count) { return P0.replicate(count, count); }

std::optional<std::vector<LocalGains>> step_local(std::span<const LocalStep> steps, const MatrixXd& Qb, MatrixXd& P) {
  const auto n = Qb.rows();
  std::vector<LocalGains> gains;
  for (const LocalStep& step : steps) {
    const auto at = static_cast<Eigen::Index>(gains.size()) * n;
    const auto found = local_gains(step.A * P.block(at, at, n, n) * step.A.transpose() + Qb, step.C, step.R);
    if (!found) return std::nullopt;
    gains.push_back(*found);
  }
  step_errors(steps, gains, Qb, P);
  return gains;
}

void step_errors(std::span<const LocalStep> steps, const std::vector<LocalGains>& gains, const MatrixXd& Qb,
                 MatrixXd& P) {
  const auto n = Qb.rows();
  for (std::size_t i = 0; i < gains.size(); ++i) {
    for (std::size_t j = i; j < gains.size(); ++j) {
      const auto row = static_cast<Eigen::Index>(i) * n, column = static_cast<Eigen::Index>(j) * n;
      MatrixXd block =
          gains[i].F * (steps[i].A * P.block(row, column, n, n) * steps[j].A.transpose() + Qb) * gains[j].F.transpose();
      if (i == j) block += own_noise(gains[i], steps[i].R);
      P.block(row, column, n, n) = block;
      P.block(column, row, n, n) = block.transpose();
    }
  }
  symmetrise(P);
}

std::optional<StationaryFilters> stationary_filters(const FusionModel& model) {
  const MatrixXd Qb = model.noise();
  StationaryFilters filters;
  std::vector<MatrixXd> F, noise;
  for (const SensorModel& sensor : model.sensors) {
    const auto Pz = solve_dare(model.A.transpose(), sensor.C.transpose(), Qb, sensor.R);
    const auto gains = Pz ? local_gains(*Pz, sensor.C, sensor.R) : std::nullopt;
    if (!gains) return std::nullopt;
    filters.gains.push_back(*gains);
    filters.Psi.push_back(gains->F * model.A);
    F.push_back(gains->F);
    noise.push_back(own_noise(*gains, sensor.R));
  }
  const MatrixXd Psi = block_diagonal(filters.Psi), driven = column_of(F);
  const auto P = solve_stein(Psi, Psi, driven * Qb * driven.transpose() + block_diagonal(noise));
  if (!P) return std::nullopt;
  filters.P = *P;
  symmetrise(filters.P);
  return filters;
}

std::vector<MatrixXd> visible_gains(const FusionModel& model, const std::vector<LocalGains>& gains) {
  std::vector<MatrixXd> visible;
  for (std::size_t i = 0; i < gains.size(); ++i) visible.push_back(gains[i].K * model.sensors[i].C);
  return visible;
}

std::optional<MatrixXd> solve_stein(MatrixXd M, MatrixXd N, MatrixXd W) {
  for (int step = 0; step < kDoublings; ++step) {
    const MatrixXd growth = M * W * N.transpose();
    W += growth;
    if (!W.allFinite()) return std::nullopt;
    if (growth.norm() <= kDoubled * W.norm()) return W;
    M = (M * M).eval();
    N = (N * N).eval();
  }
  return std::nullopt;
}

std::optional<MatrixXd> state_covariance(const FusionModel& model) {
  if (!(spectral_radius(model.A) < 1)) return std::nullopt;
  auto S = solve_stein(model.A, model.A, model.noise());
  if (S) symmetrise(*S);
  return S;
}

}  // namespace vigil::privacy
