#include "engine/methods/detectors/detector.hpp"

#include <limits>

namespace vigil {

double NormalisedSquare::operator()(const Eigen::Ref<const Eigen::VectorXd>& r,
                                    const Eigen::Ref<const Eigen::MatrixXd>& S) {
  if (S.size() == 0) return std::numeric_limits<double>::quiet_NaN();
  factor_.compute(S);
  if (factor_.info() != Eigen::Success) return std::numeric_limits<double>::quiet_NaN();
  whitened_ = r;
  factor_.matrixL().solveInPlace(whitened_);
  return whitened_.squaredNorm();
}

}  // namespace vigil
