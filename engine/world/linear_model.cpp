#include "engine/world/controller.hpp"

namespace vigil {

LinearModel linear_model(const Plant& plant) {
  const int n = plant.states(), m = plant.inputs();
  const Eigen::VectorXd origin = Eigen::VectorXd::Zero(n);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(m), column(n);
  LinearModel model{Eigen::MatrixXd(n, n), Eigen::MatrixXd(n, m)};
  plant.jacobian(origin, u, model.A);
  for (int i = 0; i < m; ++i) {
    u.setZero();
    u[i] = 1;
    plant.advance(origin, u, column);
    model.B.col(i) = column;
  }
  return model;
}

}  // namespace vigil
