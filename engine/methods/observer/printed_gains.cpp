#include "engine/methods/observer/printed_gains.hpp"

namespace vigil::observer {

Gains printed_gains() {
  Eigen::MatrixXd L1(6, 3), L2(5, 3);
  L1 << -.0037, .2301, -.0337, .0001, .0026, -.0004, -.0104, .0225, .0013, -.0017, -.0529, .0089, .0140, -.2538, .0326,
      .3748, -6.7778, .8703;
  L2 << -2.4302, 27.6955, 37.8731, 19.0229, 15.6234, 1.1199, -15.6263, 20.8778, 42.2655, -5.4285, -29.6888, -32.9860,
      -4.5351, -284.1874, -360.2424;
  return {1e4 * L1, L2};
}

}  // namespace vigil::observer
