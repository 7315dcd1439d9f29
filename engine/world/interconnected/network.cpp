#include "engine/world/interconnected/network.hpp"

#include <cmath>

namespace vigil::observer {
namespace {

double shape(Nonlinearity kind, const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Index entry) {
  switch (kind) {
    case Nonlinearity::sine:
      return std::sin(x[entry]);
    case Nonlinearity::tanh:
      return std::tanh(x[entry]);
    case Nonlinearity::sine_last:
      return std::sin(x[x.size() - 1 - entry]);
    case Nonlinearity::none:
      break;
  }
  return 0;
}

void size_if_empty(Eigen::MatrixXd& matrix, int rows) {
  if (matrix.size() == 0) matrix.resize(rows, matrix.rows() == rows ? matrix.cols() : 0);
}

}  // namespace

const Eigen::MatrixXd* Network::coupling(int to, int from) const {
  for (const Coupling& one : couplings) {
    if (one.to == to && one.from == from) return &one.H;
  }
  return nullptr;
}

void complete(Subsystem& subsystem) {
  for (Eigen::MatrixXd* matrix : {&subsystem.B, &subsystem.F, &subsystem.D, &subsystem.Dd}) {
    size_if_empty(*matrix, subsystem.n());
  }
  size_if_empty(subsystem.G, subsystem.p());
  if (subsystem.E.size() == 0) subsystem.E = Eigen::MatrixXd::Identity(subsystem.p(), subsystem.p());
}

void nonlinearity(const Subsystem& subsystem, const Eigen::Ref<const Eigen::VectorXd>& x,
                  Eigen::Ref<Eigen::VectorXd> phi) {
  const int n = subsystem.n(), r = subsystem.r();
  const double share =
      subsystem.tau / std::sqrt((r + n - 1) / n);  // a state that serves several entries serves each less
  for (int entry = 0; entry < r; ++entry) phi[entry] = share * shape(subsystem.phi, x, entry % n);
}

}  // namespace vigil::observer
