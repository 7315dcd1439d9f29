#include "engine/methods/kalman.hpp"

#include <cmath>
#include <limits>

namespace vigil {

void kalman_predict(Gaussian& state, const Plant& plant, const Eigen::VectorXd& input, const Eigen::MatrixXd& Q) {
  const auto n = state.mean.size();
  BoundedMatrix F(n, n);
  BoundedVector next(n);
  plant.jacobian(state.mean, input, F);
  plant.advance(state.mean, input, next);
  state.mean = next;
  BoundedMatrix FP(n, n);
  FP.noalias() = F * state.covariance;
  state.covariance = Q;
  state.covariance.noalias() += FP * F.transpose();
  symmetrise(state.covariance);
}

Innovation innovate(const Sensor& sensor, const Eigen::VectorXd& reading, const BoundedVector& point, bool as_printed) {
  const int m = sensor.size();
  BoundedVector predicted(m);
  BoundedMatrix H(m, point.size());
  sensor.measure(point, predicted);
  as_printed ? sensor.jacobian_as_printed(point, H) : sensor.jacobian(point, H);
  int kept[kMaxSmall];
  int count = 0;
  for (int c = 0; c < m; ++c) {
    if (std::isfinite(reading[c])) kept[count++] = c;
  }
  Innovation innovation;
  innovation.r.resize(count);
  innovation.H.resize(count, point.size());
  innovation.R.resize(count, count);
  for (int a = 0; a < count; ++a) {
    const auto& channel = sensor.channels()[static_cast<std::size_t>(kept[a])];
    innovation.r[a] = wrap(reading[kept[a]] - predicted[kept[a]], channel.period);
    innovation.H.row(a) = H.row(kept[a]);
    for (int b = 0; b < count; ++b) innovation.R(a, b) = sensor.noise()(kept[a], kept[b]);
  }
  return innovation;
}

BoundedMatrix innovation_covariance(const Innovation& innovation, const BoundedMatrix& P) {
  BoundedMatrix HP(innovation.H.rows(), P.cols());
  HP.noalias() = innovation.H * P;
  BoundedMatrix S = innovation.R;
  S.noalias() += HP * innovation.H.transpose();
  return S;
}

bool kalman_update(Gaussian& state, const Innovation& innovation) {
  const Eigen::LLT<BoundedMatrix> cholesky(innovation_covariance(innovation, state.covariance));
  if (cholesky.info() != Eigen::Success) return false;
  const auto n = state.mean.size();
  BoundedMatrix HP(innovation.H.rows(), n);
  HP.noalias() = innovation.H * state.covariance;
  const BoundedMatrix Kt = cholesky.solve(HP);  // K' = S^-1 H P
  state.mean.noalias() += Kt.transpose() * innovation.r;
  BoundedMatrix A = BoundedMatrix::Identity(n, n);
  A.noalias() -= Kt.transpose() * innovation.H;
  BoundedMatrix AP(n, n), RK(innovation.R.rows(), n);
  AP.noalias() = A * state.covariance;
  RK.noalias() = innovation.R * Kt;
  state.covariance.noalias() = AP * A.transpose();
  state.covariance.noalias() += Kt.transpose() * RK;
  symmetrise(state.covariance);
  return state.mean.allFinite() && state.covariance.allFinite();
}

double mahalanobis(const Innovation& innovation, const BoundedMatrix& P) {
  const Eigen::LLT<BoundedMatrix> cholesky(innovation_covariance(innovation, P));
  if (cholesky.info() != Eigen::Success) return std::numeric_limits<double>::quiet_NaN();
  const BoundedVector whitened = cholesky.matrixL().solve(innovation.r);
  return whitened.squaredNorm();
}

}  // namespace vigil
