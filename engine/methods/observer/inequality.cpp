#include "engine/methods/observer/inequality.hpp"

namespace vigil::observer {
namespace {

using Matrix = Eigen::MatrixXd;

/// Adds M at (row, column) and M' across the diagonal.
void add_pair(Matrix& sigma, Eigen::Index row, Eigen::Index column, const Matrix& M) {
  sigma.block(row, column, M.rows(), M.cols()) += M;
  sigma.block(column, row, M.cols(), M.rows()) += M.transpose();
}

/// The blocks off the diagonal hold -P_to K for every coupling, and its mirror image.
void add_coupling(const ErrorSystem& system, std::size_t i, const Matrix& P, const std::vector<int>& first,
                  Matrix& sigma) {
  for (const ErrorCoupling& one : system.couplings) {
    if (static_cast<std::size_t>(one.to) != i) continue;
    add_pair(sigma, first[i], first[static_cast<std::size_t>(one.from)], -P * one.K);
  }
}

}  // namespace

int sigma_order(const ErrorPart& part) {
  return static_cast<int>(part.Abar.rows() + part.Kbar.cols() + part.Wbar.cols() + part.Fbar.cols());
}

Matrix lyapunov_part(const ErrorPart& part, const Parts& parts) {
  const auto size = part.Abar.rows();
  Matrix half = Matrix::Zero(size, size);
  if (parts.P.size() > 0) half += parts.P * part.Abar + part.decay * parts.P;
  if (parts.W.size() > 0) half -= part.mu * parts.W * part.Cbar;
  return half + half.transpose();
}

void add_sigma(const ErrorSystem& system, std::size_t i, const Parts& parts, const std::vector<int>& first,
               Matrix& sigma) {
  const ErrorPart& part = system.parts[i];
  const auto size = part.Abar.rows(), d = part.Kbar.cols(), w = part.Wbar.cols(), phi = part.Fbar.cols();
  const Eigen::Index at = first[i];
  auto of_e = sigma.block(at, at, size, size);
  of_e += lyapunov_part(part, parts);
  if (phi > 0) of_e += part.tau * part.tau * parts.kappa * (part.Mbar.transpose() * part.Mbar);
  if (parts.P.size() > 0) {
    add_pair(sigma, at, at + size, parts.P * part.Kbar);
    add_pair(sigma, at, at + size + d, parts.P * part.Wbar);
    add_pair(sigma, at, at + size + d + w, parts.P * part.Fbar);
    add_coupling(system, i, parts.P, first, sigma);
  }
  auto diagonal = sigma.diagonal();
  diagonal.segment(at + size, d).array() -= parts.gd2;
  diagonal.segment(at + size + d, w).array() -= parts.gw2;
  diagonal.segment(at + size + d + w, phi).array() -= parts.kappa;
}

void add_sigma_constant(const ErrorPart& part, int first, Matrix& sigma) {
  sigma.diagonal().segment(first, part.Abar.rows()).array() += 1;
}

}  // namespace vigil::observer
