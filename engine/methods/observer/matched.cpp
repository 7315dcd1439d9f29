#include "engine/methods/observer/matched.hpp"

#include <Eigen/Cholesky>
#include <Eigen/SVD>

namespace vigil::observer {
namespace {

using Matrix = Eigen::MatrixXd;

constexpr double kRank = 1e-10;

Eigen::Index rank(const Matrix& M) {
  if (M.size() == 0) return 0;
  Eigen::JacobiSVD<Matrix> svd(M);
  svd.setThreshold(kRank);
  return svd.rank();
}

}  // namespace

bool matching_condition(const Subsystem& s) { return rank(s.C * s.D) == rank(s.D); }

Matching matching(const Subsystem& s) {
  const Matrix CD = s.C * s.D;
  Matching result{.holds = matching_condition(s), .inverse = Matrix::Zero(s.q(), s.p())};
  if (result.holds && s.q() > 0) result.inverse = (CD.transpose() * CD).ldlt().solve(CD.transpose());
  result.projection = Matrix::Identity(s.n(), s.n()) - s.D * result.inverse * s.C;
  return result;
}

ErrorSystem matched_error_system(const Network& network) {
  ErrorSystem system;
  std::vector<Matrix> projections;
  for (const Subsystem& s : network.subsystems) {
    projections.push_back(matching(s).projection);
    const int n = s.n();
    system.parts.push_back({.Abar = projections.back() * s.A,
                            .Cbar = s.C,
                            .Fbar = Matrix::Zero(n, 0),
                            .Kbar = Matrix::Zero(n, 0),
                            .Wbar = Matrix::Zero(n, 0),
                            .Mbar = Matrix::Identity(n, n),
                            .decay = 1});
  }
  for (const Coupling& one : network.couplings) {
    const auto to = static_cast<std::size_t>(one.to);
    system.couplings.push_back({one.to, one.from, network.subsystems[to].alpha * (projections[to] * one.H)});
  }
  return system;
}

}  // namespace vigil::observer
