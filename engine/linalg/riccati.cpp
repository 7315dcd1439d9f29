#include "engine/linalg/riccati.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <complex>
#include <limits>

namespace vigil {
namespace {

constexpr double kModulus = 1e-8;   // below 1 by less than this counts as undamped
constexpr double kRank = 1e-10;     // of the size of A
constexpr int kDoublings = 60;      // 2^60 steps of the plain iteration
constexpr int kNewtonSteps = 60;    // it doubles the correct digits; a far start needs a few more
constexpr double kSettled = 1e-14;  // relative change that ends an iteration
constexpr double kResidual = 1e-9;  // of the equation's largest term

bool symmetric(const Eigen::MatrixXd& M) {
  return (M - M.transpose()).cwiseAbs().maxCoeff() <= 1e-9 * M.cwiseAbs().maxCoeff();
}

bool well_posed(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, const Eigen::MatrixXd& Q,
                const Eigen::MatrixXd& R) {
  const auto n = A.rows(), m = B.cols();
  const bool fits = n > 0 && m > 0 && A.cols() == n && B.rows() == n && Q.rows() == n && Q.cols() == n &&
                    R.rows() == m && R.cols() == m;
  if (!fits || !A.allFinite() || !B.allFinite() || !Q.allFinite() || !R.allFinite()) return false;
  if (!symmetric(Q) || !symmetric(R)) return false;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> of_q(Q, Eigen::EigenvaluesOnly);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> of_r(R, Eigen::EigenvaluesOnly);
  const double size = Q.cwiseAbs().maxCoeff();
  return of_q.eigenvalues()[0] >= -1e-12 * size && of_r.eigenvalues()[0] > 0;
}

/// The limit of S <- A'S(I + G S)^-1 A + Q from S = Q, G = B R^-1 B', in doubling steps. Nothing where it grows without
/// bound.
std::optional<Eigen::MatrixXd> doubling(Eigen::MatrixXd A, Eigen::MatrixXd G, Eigen::MatrixXd S) {
  const Eigen::MatrixXd I = Eigen::MatrixXd::Identity(A.rows(), A.rows());
  for (int step = 0; step < kDoublings; ++step) {
    const Eigen::PartialPivLU<Eigen::MatrixXd> W(I + G * S);
    const Eigen::MatrixXd WA = W.solve(A), WG = W.solve(G);
    const Eigen::MatrixXd growth = A.transpose() * S * WA;
    G += A * WG * A.transpose();
    G = (0.5 * (G + G.transpose())).eval();
    S += 0.5 * (growth + growth.transpose());
    A = (A * WA).eval();
    if (!S.allFinite() || !G.allFinite() || !A.allFinite()) return std::nullopt;
    if (growth.norm() <= kSettled * S.norm()) return S;
  }
  return std::nullopt;
}

/// S = F'SF + W for F with spectral radius below 1, in doubling steps.
Eigen::MatrixXd stein(Eigen::MatrixXd F, Eigen::MatrixXd W) {
  for (int step = 0; step < kDoublings; ++step) {
    const Eigen::MatrixXd growth = F.transpose() * W * F;
    W += 0.5 * (growth + growth.transpose());
    F = (F * F).eval();
    if (!(growth.norm() > kSettled * W.norm()) || !W.allFinite()) break;
  }
  return W;
}

/// Hewer: from a gain that stabilises, the cost of each gain and the best gain for that cost, in turn. Ends where the
/// step stops shrinking: that is rounding.
std::optional<Eigen::MatrixXd> newton(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, const Eigen::MatrixXd& Q,
                                      const Eigen::MatrixXd& R, Eigen::MatrixXd L) {
  Eigen::MatrixXd S;
  double last = std::numeric_limits<double>::infinity();
  for (int step = 0; step < kNewtonSteps; ++step) {
    const Eigen::MatrixXd F = A + B * L;
    if (!(spectral_radius(F) < 1)) return std::nullopt;
    const Eigen::MatrixXd next = stein(F, Q + L.transpose() * R * L);
    if (!next.allFinite()) return std::nullopt;
    const double change = step == 0 ? last : (next - S).norm();
    S = next;
    L = lqr_gain(A, B, R, S);
    const bool close = change <= 1e-8 * S.norm();
    if (change <= kSettled * S.norm() || (close && change >= last)) break;
    last = change;
  }
  return S;
}

double residual(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, const Eigen::MatrixXd& Q, const Eigen::MatrixXd& R,
                const Eigen::MatrixXd& S) {
  const Eigen::MatrixXd carried = A.transpose() * S * A;
  const Eigen::MatrixXd rest = carried + A.transpose() * S * B * lqr_gain(A, B, R, S) + Q - S;
  return rest.norm() / (carried.norm() + Q.norm() + S.norm() + std::numeric_limits<double>::min());
}

}  // namespace

double spectral_radius(const Eigen::MatrixXd& A) {
  if (!A.allFinite()) return std::numeric_limits<double>::infinity();
  if (A.size() == 0) return 0;
  return Eigen::EigenSolver<Eigen::MatrixXd>(A, false).eigenvalues().cwiseAbs().maxCoeff();
}

bool stabilisable(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  if (!A.allFinite() || !B.allFinite()) return false;
  const auto n = A.rows();
  const double size = A.norm();
  Eigen::MatrixXd ways = B;
  for (auto column : ways.colwise()) {  // the unit of an input says nothing
    const double length = column.norm();
    if (length > 0) column *= size / length;
  }
  const Eigen::VectorXcd modes = Eigen::EigenSolver<Eigen::MatrixXd>(A, false).eigenvalues();
  Eigen::MatrixXcd pencil(n, n + B.cols());
  for (const std::complex<double>& mode : modes) {
    if (std::abs(mode) < 1 - kModulus) continue;
    pencil << mode * Eigen::MatrixXcd::Identity(n, n) - A, ways.cast<std::complex<double>>();
    const Eigen::JacobiSVD<Eigen::MatrixXcd> svd(pencil);
    if (!(svd.singularValues()[n - 1] > kRank * size)) return false;
  }
  return true;
}

bool detectable(const Eigen::MatrixXd& A, const Eigen::MatrixXd& C) {
  return stabilisable(A.transpose(), C.transpose());
}

Eigen::MatrixXd lqr_gain(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, const Eigen::MatrixXd& R,
                         const Eigen::MatrixXd& S) {
  const Eigen::MatrixXd SB = S * B;
  return -(B.transpose() * SB + R).llt().solve(SB.transpose() * A);
}

std::optional<Eigen::MatrixXd> solve_dare(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, const Eigen::MatrixXd& Q,
                                          const Eigen::MatrixXd& R) {
  if (!well_posed(A, B, Q, R) || !stabilisable(A, B)) return std::nullopt;
  const auto n = A.rows();
  const Eigen::MatrixXd G = B * R.llt().solve(B.transpose());
  auto start = doubling(A, G, Q);
  const auto stabilises = [&] { return start && spectral_radius(A + B * lqr_gain(A, B, R, *start)) < 1; };
  if (!stabilises()) {
    // Q leaves an unstable mode unweighed; any weight on all of them gives a gain to start from.
    const double weight = Q.norm() + R.norm() / (1 + B.squaredNorm());
    start = doubling(A, G, Q + weight * Eigen::MatrixXd::Identity(n, n));
    if (!stabilises()) return std::nullopt;
  }
  const auto S = newton(A, B, Q, R, lqr_gain(A, B, R, *start));
  if (!S || !(residual(A, B, Q, R, *S) < kResidual)) return std::nullopt;
  if (!(spectral_radius(A + B * lqr_gain(A, B, R, *S)) < 1 - kModulus)) return std::nullopt;
  return S;
}

}  // namespace vigil
