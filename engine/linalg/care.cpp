#include "engine/linalg/care.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <cmath>
#include <complex>
#include <limits>

#include "engine/linalg/covariance.hpp"

namespace vigil {
namespace {

using Matrix = Eigen::MatrixXd;

constexpr double kUndamped = 1e-8;  // of A's size: a real part above minus this does not decay
constexpr double kRank = 1e-10;     // of the size of A
constexpr int kSignSteps = 100;     // quadratic once near; the scaling makes the way there short
constexpr int kNewtonSteps = 60;
constexpr double kSettled = 1e-14;
constexpr double kResidual = 1e-9;  // of the equation's largest term

bool symmetric(const Matrix& M) { return (M - M.transpose()).cwiseAbs().maxCoeff() <= 1e-9 * M.cwiseAbs().maxCoeff(); }

bool well_posed(const Matrix& A, const Matrix& C, const Matrix& Q, const Matrix& R) {
  const auto n = A.rows(), p = C.rows();
  const bool fits = n > 0 && p > 0 && A.cols() == n && C.cols() == n && Q.rows() == n && Q.cols() == n &&
                    R.rows() == p && R.cols() == p;
  if (!fits || !A.allFinite() || !C.allFinite() || !Q.allFinite() || !R.allFinite()) return false;
  if (!symmetric(Q) || !symmetric(R)) return false;
  return least_eigenvalue(Q) >= -1e-12 * Q.cwiseAbs().maxCoeff() && least_eigenvalue(R) > 0;
}

/// X of F X + X F' + W = 0 for F with a negative abscissa: by F's Schur form, one column after the other.
Matrix lyapunov(const Matrix& F, const Matrix& W) {
  const auto n = F.rows();
  const Eigen::ComplexSchur<Matrix> schur(F);
  const Eigen::MatrixXcd &T = schur.matrixT(), &U = schur.matrixU();
  const Eigen::MatrixXcd right = -(U.adjoint() * W * U);
  Eigen::MatrixXcd Y = right, shifted = T;
  for (Eigen::Index j = n - 1; j >= 0; --j) {
    Eigen::VectorXcd column = right.col(j);
    for (Eigen::Index k = j + 1; k < n; ++k) column -= Y.col(k) * std::conj(T(j, k));
    shifted.diagonal() = T.diagonal().array() + std::conj(T(j, j));
    Y.col(j) = shifted.triangularView<Eigen::Upper>().solve(column);
  }
  const Matrix X = (U * Y * U.adjoint()).real();
  return 0.5 * (X + X.transpose());
}

/// The sign of a matrix without eigenvalues on the imaginary axis: Newton's iteration, scaled by the determinant
/// (Byers, 1987).
std::optional<Matrix> sign_of(Matrix Z) {
  const auto order = static_cast<double>(Z.rows());
  for (int step = 0; step < kSignSteps; ++step) {
    const Eigen::PartialPivLU<Matrix> lu(Z);
    const Matrix inverse = lu.inverse();
    if (!inverse.allFinite()) return std::nullopt;
    const double log_modulus = lu.matrixLU().diagonal().array().abs().log().sum();
    const double scale = std::exp(-log_modulus / order);
    const Matrix next = 0.5 * (scale * Z + inverse / scale);
    const double change = (next - Z).norm();
    Z = next;
    if (!Z.allFinite()) return std::nullopt;
    if (change <= 1e-12 * Z.norm()) return Z;
  }
  return Z;  // rounding may keep it from settling; Newton's iteration on the equation decides
}

/// The stabilising solution from the stable half of the Hamiltonian, in the variable X / size that makes Q and G alike.
std::optional<Matrix> from_sign(const Matrix& A, const Matrix& G, const Matrix& Q) {
  const auto n = A.rows();
  const double size = G.norm() > 0 && Q.norm() > 0 ? std::sqrt(Q.norm() / G.norm()) : 1;
  Matrix H(2 * n, 2 * n);
  H << A.transpose(), -size * G, -Q / size, -A;
  const auto sign = sign_of(H);
  if (!sign) return std::nullopt;
  const Matrix I = Matrix::Identity(n, n);
  Matrix left(2 * n, n), right(2 * n, n);
  left << sign->topRightCorner(n, n), sign->bottomRightCorner(n, n) + I;
  right << sign->topLeftCorner(n, n) + I, sign->bottomLeftCorner(n, n);
  const Matrix X = -size * left.colPivHouseholderQr().solve(right);
  if (!X.allFinite()) return std::nullopt;
  return 0.5 * (X + X.transpose());
}

/// Kleinman: from a gain that stabilises, the covariance of each gain and the best gain for that, in turn. Ends where
/// the step stops shrinking: that is rounding.
std::optional<Matrix> newton(const Matrix& A, const Matrix& G, const Matrix& Q, Matrix X) {
  double last = std::numeric_limits<double>::infinity();
  for (int step = 0; step < kNewtonSteps; ++step) {
    const Matrix F = A - X * G;
    if (!(spectral_abscissa(F) < 0)) return std::nullopt;
    const Matrix next = lyapunov(F, Q + X * G * X);
    if (!next.allFinite()) return std::nullopt;
    const double change = (next - X).norm();
    X = next;
    if (change <= kSettled * X.norm() || (change <= 1e-8 * X.norm() && change >= last)) break;
    last = change;
  }
  return X;
}

double residual(const Matrix& A, const Matrix& G, const Matrix& Q, const Matrix& X) {
  const Matrix moved = A * X, taken = X * G * X;
  const double size = 2 * moved.norm() + taken.norm() + Q.norm() + std::numeric_limits<double>::min();
  return (moved + moved.transpose() - taken + Q).norm() / size;
}

/// Newton's iteration from X, in X's own coordinates, where the answer is near the identity whatever the states' units:
/// rounding would hide an equation whose terms differ by ten orders. In the given ones where X is singular.
std::optional<Matrix> polished(const Matrix& A, const Matrix& G, const Matrix& Q, const Matrix& X) {
  const auto n = A.rows();
  const Eigen::LLT<Matrix> factor(X);
  const Matrix T = factor.info() == Eigen::Success ? Matrix(factor.matrixL()) : Matrix::Identity(n, n);
  const auto lower = T.triangularView<Eigen::Lower>();
  const Matrix half = lower.solve(Q);
  const Matrix A_there = lower.solve(A * T), G_there = T.transpose() * G * T;
  const Matrix Q_there = lower.solve(half.transpose());
  const Matrix start = factor.info() == Eigen::Success ? Matrix::Identity(n, n) : X;
  const auto there = newton(A_there, G_there, 0.5 * (Q_there + Q_there.transpose()), start);
  if (!there || !(residual(A_there, G_there, Q_there, *there) < kResidual)) return std::nullopt;
  const Matrix back = T * *there * T.transpose();
  return 0.5 * (back + back.transpose());
}

}  // namespace

double spectral_abscissa(const Matrix& A) {
  if (!A.allFinite()) return std::numeric_limits<double>::infinity();
  if (A.size() == 0) return -std::numeric_limits<double>::infinity();
  return Eigen::EigenSolver<Matrix>(A, false).eigenvalues().real().maxCoeff();
}

bool detectable_continuous(const Matrix& A, const Matrix& C) {
  if (!A.allFinite() || !C.allFinite()) return false;
  const auto n = A.rows();
  const double size = A.norm() > 0 ? A.norm() : 1;
  const Matrix seen = C * (size / (C.norm() > 0 ? C.norm() : 1));  // their common unit says nothing
  const Eigen::VectorXcd modes = Eigen::EigenSolver<Matrix>(A, false).eigenvalues();
  Eigen::MatrixXcd pencil(n + C.rows(), n);
  for (const std::complex<double>& mode : modes) {
    if (mode.real() < -kUndamped * size) continue;
    pencil << mode * Eigen::MatrixXcd::Identity(n, n) - A, seen.cast<std::complex<double>>();
    const Eigen::JacobiSVD<Eigen::MatrixXcd> svd(pencil);
    if (!(svd.singularValues()[n - 1] > kRank * size)) return false;
  }
  return true;
}

std::optional<Matrix> solve_care(const Matrix& A, const Matrix& C, const Matrix& Q, const Matrix& R) {
  if (!well_posed(A, C, Q, R)) return std::nullopt;
  const Matrix G = C.transpose() * R.llt().solve(C);
  const auto start = from_sign(A, G, Q);
  if (!start) return std::nullopt;
  const auto near = newton(A, G, Q, *start);
  if (!near) return std::nullopt;
  const auto X = polished(A, G, Q, *near);
  if (!X) return std::nullopt;
  if (!(spectral_abscissa(A - *X * G) < 0)) return std::nullopt;
  return X;
}

}  // namespace vigil
