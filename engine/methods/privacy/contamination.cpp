#include "engine/methods/privacy/contamination.hpp"

#include <Eigen/Cholesky>
#include <cmath>

#include "engine/linalg/small.hpp"
#include "engine/methods/privacy/null_space.hpp"

namespace vigil::privacy {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd contaminated_mask(const VectorXd& h) { return VectorXd::Ones(h.size()) - h; }

}  // namespace

VectorXd kept(const ComponentSet& contaminated, int stacked) {
  VectorXd h = VectorXd::Ones(stacked);
  for (const int component : contaminated) h[component] = 0;
  return h;
}

MatrixXd contamination_projector(const MatrixXd& W, const VectorXd& h) {
  return null_projector(W * contaminated_mask(h).asDiagonal());
}

int contamination_null_dim(const MatrixXd& W, const VectorXd& h) {
  const VectorXd gone = contaminated_mask(h);
  return static_cast<int>(std::lround(gone.sum())) - numerical_rank(W * gone.asDiagonal());
}

VectorXd contaminate(const VectorXd& xhat, const VectorXd& h, const MatrixXd& Pi, const VectorXd& a) {
  return h.cwiseProduct(xhat) + contaminated_mask(h).cwiseProduct(Pi * a);
}

VectorXd compensate(const VectorXd& xr, const VectorXd& h, const VectorXd& p) {
  return h.cwiseProduct(xr) + contaminated_mask(h).cwiseProduct(p.replicate(xr.size() / p.size(), 1));
}

Legitimate legitimate_start(const MatrixXd& P0, int count) {
  return {.Wf = stack(static_cast<int>(P0.rows()), count).transpose() / count,
          .P = P0,
          .X = P0.replicate(1, count),
          .S = {}};
}

Legitimate legitimate_from(const MatrixXd& P, int n) {
  const Fusion nominal = fuse(P, n);
  return {.Wf = nominal.W, .P = nominal.P, .X = nominal.W * P, .S = {}};
}

Foresight foresee(std::span<const LocalStep> steps, const std::vector<LocalGains>& gains, const MatrixXd& Qb,
                  const MatrixXd& Af, const Legitimate& user) {
  const auto n = Qb.rows();
  Foresight prediction{.P = Af * user.P * Af.transpose() + Qb,
                       .X = MatrixXd(n * static_cast<Eigen::Index>(steps.size()), n)};
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i) * n;
    prediction.X.middleRows(at, n) =
        gains[i].F * (steps[i].A * user.X.middleCols(at, n).transpose() * Af.transpose() + Qb);
  }
  return prediction;
}

void take_in(const MatrixXd& P, const Foresight& prediction, const VectorXd& h, const MatrixXd& noise,
             Legitimate& user) {
  const auto n = prediction.P.rows();
  const auto count = P.rows() / n;
  const VectorXd gone = contaminated_mask(h);
  const auto H = h.asDiagonal(), Hb = gone.asDiagonal();
  const MatrixXd mixed = H * prediction.X.replicate(1, count) * Hb;
  user.S = H * (noise.size() > 0 ? MatrixXd(P + noise) : P) * H;
  user.S += mixed + mixed.transpose();
  user.S += Hb * prediction.P.replicate(count, count) * Hb;
  symmetrise(user.S);
  const Fusion fused = fuse(user.S, static_cast<int>(n));
  user.Wf = fused.W;
  user.P = fused.P;
  MatrixXd of_locals = H * P;
  of_locals += Hb * prediction.X.transpose().replicate(count, 1);
  user.X = user.Wf * of_locals;
}

void step_legitimate(std::span<const LocalStep> steps, const std::vector<LocalGains>& gains, const MatrixXd& Qb,
                     const MatrixXd& P, const MatrixXd& Af, const VectorXd& h, Legitimate& user) {
  take_in(P, foresee(steps, gains, Qb, Af, user), h, {}, user);
}

MatrixXd eavesdropper_covariance(const Fusion& nominal, const MatrixXd& P, const MatrixXd& Lam, const VectorXd& h) {
  const auto n = Lam.rows();
  const auto count = P.rows() / n;
  MatrixXd own(P.rows(), n);  // E[local errors * x']: an error is orthogonal to its estimate
  for (Eigen::Index i = 0; i < count; ++i) own.middleRows(i * n, n) = P.block(i * n, i * n, n, n);
  const VectorXd gone = contaminated_mask(h);
  const MatrixXd local = nominal.W * h.asDiagonal();
  const MatrixXd absent = nominal.W * gone.asDiagonal() * stack(static_cast<int>(n), static_cast<int>(count));
  const MatrixXd mixed = local * own * absent.transpose();
  MatrixXd Pe = local * P * local.transpose() + absent * Lam * absent.transpose() + mixed + mixed.transpose();
  symmetrise(Pe);
  return Pe;
}

MatrixXd second_moment_gain(const Fusion& nominal, const MatrixXd& Lam, int count) {
  const MatrixXd share = (Lam + nominal.P).llt().solve(Lam).transpose();
  return (share * nominal.W).replicate(count, 1);
}

}  // namespace vigil::privacy
