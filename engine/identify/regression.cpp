#include "engine/identify/regression.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace vigil::identify {
namespace {

constexpr double kWorstCondition = 1e8;
constexpr double kFlat = 1e-10;  ///< standard deviation of a regressor that does not move, of its own size

}  // namespace

Regression regress(const Eigen::MatrixXd& Z, const Eigen::MatrixXd& Y) {
  const auto rows = static_cast<double>(Z.rows());
  const Eigen::RowVectorXd centre = Z.colwise().mean(), target = Y.colwise().mean();
  Eigen::MatrixXd standard = Z.rowwise() - centre;
  Eigen::VectorXd scale = (standard.colwise().squaredNorm() / rows).cwiseSqrt().transpose();
  Regression result;
  for (Eigen::Index c = 0; c < Z.cols(); ++c) {
    const bool flat = !(scale[c] > kFlat * std::max(Z.col(c).cwiseAbs().maxCoeff(), 1e-290));
    if (flat) result.flat.push_back(static_cast<int>(c));
    scale[c] = flat ? 0 : 1 / scale[c];
  }
  standard *= scale.asDiagonal();
  Eigen::MatrixXd correlation = standard.transpose() * standard / rows;
  for (const int c : result.flat) correlation(c, c) = 1;  // a zero row would make it singular for nothing
  if (Z.cols() > 0) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> spectrum(correlation, Eigen::EigenvaluesOnly);
    const double least = spectrum.eigenvalues()[0], most = spectrum.eigenvalues()[Z.cols() - 1];
    if (least * kWorstCondition < most) result.ridge = most / kWorstCondition;
    correlation.diagonal().array() += result.ridge;
  }
  const Eigen::MatrixXd sides = standard.transpose() * (Y.rowwise() - target) / rows;
  const Eigen::MatrixXd solution = correlation.ldlt().solve(sides);
  result.weights = (scale.asDiagonal() * solution).transpose();
  result.constant = target.transpose() - result.weights * centre.transpose();
  return result;
}

}  // namespace vigil::identify
