#include "engine/methods/privacy/null_space.hpp"

#include <Eigen/SVD>

namespace vigil::privacy {
namespace {

using Eigen::MatrixXd;

constexpr double kZero = 1e-10;  // of the largest singular value

int rank_of(const Eigen::VectorXd& singular) {
  const double least = singular.size() > 0 ? kZero * singular[0] : 0;
  int rank = 0;
  while (rank < singular.size() && singular[rank] > least) ++rank;
  return rank;
}

}  // namespace

int numerical_rank(const MatrixXd& G) { return rank_of(Eigen::JacobiSVD<MatrixXd>(G).singularValues()); }

MatrixXd null_projector(const MatrixXd& G) {
  const Eigen::JacobiSVD<MatrixXd> svd(G, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const MatrixXd seen = svd.matrixV().leftCols(rank_of(svd.singularValues()));
  return MatrixXd::Identity(G.cols(), G.cols()) - seen * seen.transpose();
}

}  // namespace vigil::privacy
