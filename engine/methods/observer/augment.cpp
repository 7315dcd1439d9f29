#include "engine/methods/observer/augment.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>

namespace vigil::observer {
namespace {

using Matrix = Eigen::MatrixXd;

const Subsystem& subsystem_of(const Network& network, int index) {
  return network.subsystems[static_cast<std::size_t>(index)];
}

/// G^+ = (G'G)^-1 G', g x p.
Matrix pseudo_inverse(const Matrix& G) {
  if (G.cols() == 0) return Matrix::Zero(0, G.rows());
  return (G.transpose() * G).ldlt().solve(G.transpose());
}

/// A matrix of n rows with p more of zeros.
Matrix padded(const Matrix& M, int p) {
  Matrix whole = Matrix::Zero(M.rows() + p, M.cols());
  whole.topRows(M.rows()) = M;
  return whole;
}

ErrorPart error_part(const Subsystem& s) {
  const Augmented a = augment(s);
  const int xi = s.n() + s.g(), q = s.q();
  ErrorPart part;
  part.Abar.resize(xi + q, xi + q);
  part.Abar << a.A2 + a.D2 * a.N, a.D2, -a.N * a.A2 - a.N * a.D2 * a.N, -a.N * a.D2;
  Matrix Nbar(xi + q, xi);
  Nbar << Matrix::Identity(xi, xi), -a.N;
  part.Cbar = Matrix::Zero(s.p(), xi + q);
  part.Cbar.leftCols(xi) = a.C1;
  part.Fbar = Nbar * a.F2;
  part.Kbar = Nbar * a.Dd2;
  part.Wbar = Matrix::Zero(xi + q, q);
  part.Wbar.bottomRows(q).setIdentity();
  part.Mbar = Matrix::Identity(s.n(), xi + q);
  part.tau = s.tau;
  part.kappa = s.kappa;
  part.mu = s.mu;
  part.integral = q;
  return part;
}

}  // namespace

Matrix left_inverse(const Subsystem& s) {
  const int n = s.n(), g = s.g(), p = s.p();
  const Matrix of_g = pseudo_inverse(s.G);
  Matrix inverse = Matrix::Zero(n + g, n + p);
  inverse.topLeftCorner(n, n).setIdentity();
  if (g == 0) return inverse;
  inverse.bottomLeftCorner(g, n) = -of_g * s.C;
  inverse.bottomRightCorner(g, p) = s.E.transpose().fullPivLu().solve(of_g.transpose()).transpose();
  return inverse;
}

Augmented augment(const Subsystem& s) {
  const int n = s.n(), g = s.g(), p = s.p();
  const Matrix inverse = left_inverse(s);
  Augmented a;
  a.C1.resize(p, n + g);
  a.C1 << s.C, s.G;
  a.C1_clean = Matrix::Zero(p, n + g);
  a.C1_clean.leftCols(n) = s.C;
  Matrix A1 = Matrix::Zero(n + p, n + g), J1 = Matrix::Zero(n + p, p), E1 = Matrix::Zero(n + p, p);
  A1.topLeftCorner(n, n) = s.A;
  A1.bottomRightCorner(p, g) = -s.G;
  J1.bottomRows(p).setIdentity();
  E1.bottomRows(p) = s.E;
  a.A2 = inverse * (A1 - J1 * a.C1_clean);
  a.B2 = inverse * padded(s.B, p);
  a.D2 = inverse * padded(s.D, p);
  a.F2 = inverse * padded(s.F, p);
  a.Dd2 = inverse * padded(s.Dd, p);
  a.J2 = inverse * J1;
  a.E2 = inverse * E1;
  a.N = s.varsigma * a.D2.transpose();
  return a;
}

Matrix augmented_coupling(const Network& network, const Coupling& coupling) {
  const Subsystem &to = subsystem_of(network, coupling.to), &from = subsystem_of(network, coupling.from);
  Matrix H1 = Matrix::Zero(to.n() + to.p(), from.n() + from.g());
  H1.topLeftCorner(to.n(), from.n()) = coupling.H;
  return left_inverse(to) * H1;
}

ErrorSystem error_system(const Network& network) {
  ErrorSystem system;
  for (const Subsystem& s : network.subsystems) system.parts.push_back(error_part(s));
  for (const Coupling& one : network.couplings) {
    const Subsystem &to = subsystem_of(network, one.to), &from = subsystem_of(network, one.from);
    const Matrix H2 = augmented_coupling(network, one), N = augment(to).N;
    Matrix K = Matrix::Zero(to.size(), from.size());
    K.topLeftCorner(H2.rows(), H2.cols()) = to.alpha * H2;
    K.bottomLeftCorner(to.q(), H2.cols()) = -to.alpha * (N * H2);
    system.couplings.push_back({one.to, one.from, K});
  }
  return system;
}

Matrix global_error_matrix(const ErrorSystem& system, const Gains& gains) {
  std::vector<Eigen::Index> first{0};
  for (const ErrorPart& part : system.parts) first.push_back(first.back() + part.Abar.rows());
  Matrix whole = Matrix::Zero(first.back(), first.back());
  for (std::size_t i = 0; i < system.parts.size(); ++i) {
    const ErrorPart& part = system.parts[i];
    const auto size = part.Abar.rows();
    whole.block(first[i], first[i], size, size) = part.Abar - part.mu * gains[i] * part.Cbar;
  }
  for (const ErrorCoupling& one : system.couplings) {
    const auto to = first[static_cast<std::size_t>(one.to)], from = first[static_cast<std::size_t>(one.from)];
    whole.block(to, from, one.K.rows(), one.K.cols()) -= one.K;
  }
  return whole;
}

std::vector<std::complex<double>> poles(const Matrix& matrix) {
  const Eigen::VectorXcd values = Eigen::EigenSolver<Matrix>(matrix, false).eigenvalues();
  std::vector<std::complex<double>> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) {
    return a.real() != b.real() ? a.real() > b.real() : a.imag() < b.imag();
  });
  return sorted;
}

}  // namespace vigil::observer
