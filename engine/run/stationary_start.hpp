/// Where a run starts whose local filters have run for ever: their errors, and on request the plant's state, drawn
/// jointly from the stationary law. Specification (privacy), sections 3.4 and 4.7.
#pragma once

#include <Eigen/Core>

#include "engine/methods/method.hpp"

namespace vigil {

class StationaryStart {
 public:
  /// with_state: the state is drawn, too. Throws InputError at /initial/estimates where plant or a sensor is not
  /// linear or a filter has no stationary law, at /initial/x0_random where the plant has none.
  StationaryStart(const Knowledge& knowledge, bool with_state);
  /// What the state is drawn away from its mean, n; zero where it is not drawn.
  Eigen::VectorXd deviation(int n) const { return draw_.head(n); }
  /// Truth minus estimate, n x sensors.
  Eigen::MatrixXd errors(int n) const;

 private:
  Eigen::VectorXd draw_;  ///< (x, errors), n + n L
};

}  // namespace vigil
