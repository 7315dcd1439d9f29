#include "tests/engine/methods/observer/letters.hpp"

namespace vigil::observer {

Eigen::VectorXd some_y(const Synthesis& synthesis, int number) {
  RandomMatrices random(number);
  return Eigen::VectorXd::NullaryExpr(synthesis.problem.variables(), [&] { return random.normal(); });
}

std::vector<Letters> letters(const ErrorSystem& system, const Eigen::VectorXd& y, bool free_kappa) {
  std::vector<Letters> all;
  Eigen::Index at = 0;
  for (const ErrorPart& part : system.parts) {
    const auto size = part.Abar.rows(), p = part.Cbar.rows();
    Letters one{.P = Eigen::MatrixXd(size, size), .W = Eigen::MatrixXd(size, p)};
    for (int column = 0; column < size; ++column) {
      for (int row = column; row < size; ++row) one.P(row, column) = one.P(column, row) = y[at++];
    }
    for (int column = 0; column < p; ++column) {
      for (int row = 0; row < size; ++row) one.W(row, column) = y[at++];
    }
    if (part.Kbar.cols() > 0) one.gd2 = y[at++];
    if (part.Wbar.cols() > 0) one.gw2 = y[at++];
    one.nu = y[at++];
    if (part.Fbar.cols() > 0) one.kappa = free_kappa || !part.kappa ? y[at++] : *part.kappa;
    all.push_back(one);
  }
  EXPECT_EQ(at, y.size());
  return all;
}

Eigen::MatrixXd printed_diagonal(const Subsystem& s, const ErrorPart& part, const Letters& y) {
  const int size = s.size(), dd = s.dd(), q = s.q(), r = s.r();
  const Eigen::MatrixXd half = y.P * part.Abar - s.mu * y.W * part.Cbar;
  Eigen::MatrixXd own = Eigen::MatrixXd::Zero(size + dd + q + r, size + dd + q + r);
  own.topLeftCorner(size, size) = half + half.transpose() + Eigen::MatrixXd::Identity(size, size);
  if (r > 0) own.diagonal().head(s.n()).array() += s.tau * s.tau * y.kappa;
  own.block(0, size, size, dd) = y.P * part.Kbar;
  own.block(0, size + dd, size, q) = y.P * part.Wbar;
  own.block(0, size + dd + q, size, r) = y.P * part.Fbar;
  for (int k = 0; k < dd; ++k) own(size + k, size + k) = -y.gd2;
  for (int k = 0; k < q; ++k) own(size + dd + k, size + dd + k) = -y.gw2;
  for (int k = 0; k < r; ++k) own(size + dd + q + k, size + dd + q + k) = -y.kappa;
  return own.selfadjointView<Eigen::Upper>();
}

Eigen::MatrixXd printed_coupling(const Network& network, const std::vector<Letters>& all, int i, int j) {
  const auto index = static_cast<std::size_t>(i);
  const Subsystem &s = network.subsystems[index], &t = network.subsystems[static_cast<std::size_t>(j)];
  const int xi = s.n() + s.g();
  Eigen::MatrixXd H3 = Eigen::MatrixXd::Zero(xi, t.size()), Nbar(s.size(), xi);
  for (const Coupling& one : network.couplings) {
    if (one.to == i && one.from == j) H3.leftCols(t.n() + t.g()) = augmented_coupling(network, one);
  }
  Nbar << Eigen::MatrixXd::Identity(xi, xi), -augment(s).N;
  return s.alpha * all[index].P * Nbar * H3;
}

Eigen::MatrixXd printed_sigma(const Network& network, const std::vector<Letters>& all) {
  const ErrorSystem system = error_system(network);
  std::vector<int> first{0};
  for (const Subsystem& s : network.subsystems) first.push_back(first.back() + s.size() + s.dd() + s.q() + s.r());
  Eigen::MatrixXd S = Eigen::MatrixXd::Zero(first.back(), first.back());
  for (int i = 0; i < network.count(); ++i) {
    const auto a = static_cast<std::size_t>(i);
    for (int j = 0; j < network.count(); ++j) {
      const auto b = static_cast<std::size_t>(j);
      const Eigen::MatrixXd block = i == j ? printed_diagonal(network.subsystems[a], system.parts[a], all[a])
                                           : Eigen::MatrixXd(-printed_coupling(network, all, i, j) -
                                                             printed_coupling(network, all, j, i).transpose());
      S.block(first[a], first[b], block.rows(), block.cols()) = block;
    }
  }
  return S;
}

double distance(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  if (a.rows() != b.rows() || a.cols() != b.cols()) return INFINITY;
  return (a - b).cwiseAbs().maxCoeff() / (1 + b.cwiseAbs().maxCoeff());
}

}  // namespace vigil::observer
