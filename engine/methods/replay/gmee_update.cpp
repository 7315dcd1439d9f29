#include "engine/methods/replay/gmee_update.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace vigil::replay {
namespace {

constexpr int kMostIterations = 50;
constexpr double kStop = 1e-6, kLeastSize = 1e-12;
constexpr double kRegularisation = 1e-12;  // of the trace
constexpr double kLeastDistance = 1e-6;    // between two errors, alpha other than 2

constexpr int kTwice = 2 * kMaxSmall;
/// Of the stacked regression's l = n + p rows.
using Stacked = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kTwice, kTwice>;
using StackedVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kTwice, 1>;
using Tall = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kTwice, kMaxSmall>;

double kernel(double distance, const GmeeSettings& settings) {
  if (settings.alpha == 2) return std::exp(-(distance / settings.beta) * (distance / settings.beta));
  const double size = std::max(distance, kLeastDistance);
  return std::pow(size, settings.alpha - 2) * std::exp(-std::pow(size / settings.beta, settings.alpha));
}

/// Lam, l x l, of the errors e.
Stacked weights(const StackedVector& e, const GmeeSettings& settings) {
  const auto l = e.size();
  const bool diagonal = settings.alpha == 2 && settings.form == GmeeForm::square;
  Stacked Phi(l, l);
  for (Eigen::Index j = 0; j < l; ++j) {
    Phi(j, j) = diagonal ? 1 : 0;
    for (Eigen::Index i = 0; i < j; ++i) Phi(i, j) = Phi(j, i) = kernel(std::abs(e[i] - e[j]), settings);
  }
  const StackedVector Psi = Phi.rowwise().sum();
  Stacked Lam(l, l);
  if (settings.form == GmeeForm::square) {
    Lam.noalias() = Phi.transpose() * Phi;
    Lam.diagonal() += Psi.cwiseAbs2();
  } else {
    Lam = -Phi;
    Lam.diagonal() += Psi;
  }
  return Lam;
}

}  // namespace

GmeeUpdate::GmeeUpdate(const Eigen::MatrixXd& C, const Eigen::MatrixXd& R, const GmeeSettings& settings)
    : C_(C), R_(R), settings_(settings) {
  const Eigen::LLT<Eigen::MatrixXd> factor(R);
  if (factor.info() == Eigen::Success) root_ = Eigen::MatrixXd(factor.matrixL());
}

std::optional<GmeeStep> GmeeUpdate::update(const BoundedVector& xp, const BoundedMatrix& Pp,
                                           const BoundedVector& y) const {
  const auto n = xp.size(), p = y.size();
  const Eigen::LLT<BoundedMatrix> of_state(Pp);
  if (root_.size() == 0 || of_state.info() != Eigen::Success) return std::nullopt;
  const auto of_sensor = root_.triangularView<Eigen::Lower>();
  Tall Wt(n + p, n);
  Wt.topRows(n) = of_state.matrixL().solve(BoundedMatrix::Identity(n, n).eval());
  Wt.bottomRows(p) = of_sensor.solve(C_);
  StackedVector d(n + p);
  d.head(n) = of_state.matrixL().solve(xp);
  d.tail(p) = of_sensor.solve(y);

  GmeeStep step{.x = xp};
  while (step.iterations < kMostIterations && !step.converged) {
    ++step.iterations;
    const StackedVector e = d - Wt * step.x;
    const Tall LamW = weights(e, settings_) * Wt;  // Lam is symmetric
    BoundedMatrix Om = Wt.transpose() * LamW;
    Om.diagonal().array() += kRegularisation * Om.trace();
    const Eigen::PartialPivLU<BoundedMatrix> solver(Om);
    const BoundedMatrix right = of_sensor.transpose().solve(LamW.bottomRows(p).eval());  // chol(R)^-T (Lam Wt)_y
    step.K = solver.solve(right.transpose());
    const BoundedVector next = xp + step.K * (y - C_ * xp);
    if (!next.allFinite()) return std::nullopt;
    step.converged = (next - step.x).norm() <= kStop * std::max(step.x.norm(), kLeastSize);
    step.x = next;
  }
  const BoundedMatrix X = BoundedMatrix::Identity(n, n) - step.K * C_;
  step.P = X * Pp * X.transpose() + step.K * R_ * step.K.transpose();
  symmetrise(step.P);
  return step;
}

}  // namespace vigil::replay
