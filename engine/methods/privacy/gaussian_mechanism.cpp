#include "engine/methods/privacy/gaussian_mechanism.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "engine/core/input_error.hpp"

namespace vigil::privacy {
namespace {

using Eigen::MatrixXd;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNoNoise = 1e-12;  // of the largest eigenvalue of the noise, or of the shift

/// exp(z^2/2) P(N(0,1) > z) for z >= 0, where neither factor alone can be represented.
double scaled_tail(double z) {
  if (z < 25) return std::exp(0.5 * z * z) * normal_tail(z);
  const double s = 1 / (z * z);  // four terms of the asymptotic series: the next is below 1e-12 here
  return (1 - s * (1 - 3 * s * (1 - 5 * s * (1 - 7 * s)))) / (z * std::sqrt(2 * std::numbers::pi));
}

/// The direction of largest growth of M' M and that growth.
std::pair<Eigen::VectorXd, double> strongest(const MatrixXd& gram) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(gram);
  const auto last = gram.cols() - 1;
  return {eigen.eigenvectors().col(last), std::max(eigen.eigenvalues()[last], 0.0)};
}

}  // namespace

double normal_tail(double z) { return 0.5 * std::erfc(z / std::numbers::sqrt2); }

double normal_tail_inverse(double p) {
  if (!(p > 0 && p < 1)) return std::numeric_limits<double>::quiet_NaN();
  double low = -40, high = 40;
  for (int i = 0; i < 200 && high - low > 1e-15 * std::max(1.0, std::abs(low)); ++i) {
    const double middle = 0.5 * (low + high);
    (normal_tail(middle) > p ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double gamma_factor(double epsilon, double delta) {
  if (!(epsilon > 0) || !std::isfinite(epsilon))
    throw InputError("/epsilon", fmt::format("epsilon is {:g}; expected a number above 0", epsilon), "above 0");
  if (!(delta > 0 && delta < 0.5))
    throw InputError("/delta", fmt::format("delta is {:g}; expected a number between 0 and 0.5", delta),
                     "between 0 and 0.5");
  const double k = normal_tail_inverse(delta);
  return (k + std::sqrt(k * k + 2 * epsilon)) / (2 * epsilon);
}

double loss_probability(double epsilon, double mu) {
  if (!(mu > 0)) return epsilon >= 0 ? 0 : 1;
  return std::isinf(mu) ? 1 : normal_tail(epsilon / mu - mu / 2);
}

double exact_delta(double epsilon, double mu) {
  if (!(mu > 0)) return 0;
  if (std::isinf(mu)) return 1;
  const double a = epsilon / mu - mu / 2, b = epsilon / mu + mu / 2;
  return std::max(normal_tail(a) - std::exp(-0.5 * a * a) * scaled_tail(b), 0.0);  // b^2/2 - epsilon = a^2/2
}

double exact_epsilon(double mu, double delta) {
  if (std::isinf(mu)) return kInfinity;
  if (exact_delta(0, mu) <= delta) return 0;
  double low = 0, high = 1;
  while (exact_delta(high, mu) > delta) high *= 2;
  for (int i = 0; i < 200 && high - low > 1e-13 * high; ++i) {
    const double middle = 0.5 * (low + high);
    (exact_delta(middle, mu) > delta ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double spectral_norm(const MatrixXd& M) { return std::sqrt(strongest(M.transpose() * M).second); }

PrivacyLoss::PrivacyLoss(const MatrixXd& D, const MatrixXd& S, double bound) {
  const Eigen::LLT<MatrixXd> factor(S);
  const double size = bound * spectral_norm(D);
  weights_ = shift_ = Eigen::VectorXd::Zero(D.rows());
  if (!(size > 0)) return;
  if (factor.info() == Eigen::Success) {
    take(D, factor.solve(D), bound);
    return;
  }
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(S);
  const double least = kNoNoise * eigen.eigenvalues().maxCoeff();
  const MatrixXd turned = eigen.eigenvectors().transpose() * D;
  Eigen::VectorXd inverse = Eigen::VectorXd::Zero(S.rows());
  for (Eigen::Index r = 0; r < S.rows(); ++r) {
    if (eigen.eigenvalues()[r] > least) inverse[r] = 1 / eigen.eigenvalues()[r];
    if (inverse[r] == 0 && bound * turned.row(r).norm() > kNoNoise * size) mu_ = kInfinity;
  }
  const auto [direction, growth] = strongest(turned.transpose() * inverse.asDiagonal() * turned);
  shift_ = bound * D * direction;
  weights_ = bound * eigen.eigenvectors() * (inverse.asDiagonal() * (turned * direction));
  if (!std::isinf(mu_)) mu_ = bound * std::sqrt(growth);
}

void PrivacyLoss::take(const MatrixXd& D, const MatrixXd& solved, double bound) {
  const auto [direction, growth] = strongest(D.transpose() * solved);
  shift_ = bound * D * direction;
  weights_ = bound * solved * direction;
  mu_ = bound * std::sqrt(growth);
}

PrivacyLoss PrivacyLoss::banded(const MatrixXd& D, const Eigen::SparseMatrix<double>& S, double bound) {
  if (!(bound * spectral_norm(D) > 0)) return {D, S, bound};
  const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::NaturalOrdering<int>> factor(S);
  if (factor.info() != Eigen::Success) return {D, S, bound};
  PrivacyLoss loss;
  loss.take(D, factor.solve(D), bound);
  return loss;
}

PrivacyLoss PrivacyLoss::white(const MatrixXd& D, const Eigen::VectorXd& variances, double bound) {
  PrivacyLoss loss;
  const double size = bound * spectral_norm(D);
  loss.weights_ = loss.shift_ = Eigen::VectorXd::Zero(D.rows());
  if (!(size > 0)) return loss;
  const Eigen::VectorXd inverse = variances.unaryExpr([](double q) { return q > 0 ? 1 / q : 0.0; });
  loss.take(D, inverse.asDiagonal() * D, bound);
  for (Eigen::Index r = 0; r < D.rows(); ++r) {
    if (inverse[r] == 0 && bound * D.row(r).norm() > kNoNoise * size) loss.mu_ = kInfinity;
  }
  return loss;
}

}  // namespace vigil::privacy
