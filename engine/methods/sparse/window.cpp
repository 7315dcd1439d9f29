#include "engine/methods/sparse/window.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <limits>

#include "engine/core/input_error.hpp"

namespace vigil::sparse {

Transition::Transition(const Eigen::MatrixXd& F, int window) {
  const Eigen::FullPivLU<Eigen::MatrixXd> lu(F);
  if (!lu.isInvertible()) throw InputError("/T", "the plant's transition cannot be inverted, so no window looks back");
  inverse_ = lu.inverse();
  powers_.push_back(BoundedMatrix::Identity(F.rows(), F.cols()));
  for (int j = 1; j < window; ++j) powers_.push_back(F * powers_.back());
}

Regression::Regression(int channels, int window, int states)
    : r(Eigen::VectorXd::Zero(channels * window)),
      Phi(Eigen::MatrixXd::Zero(channels * window, states)),
      whiten(BoundedMatrix::Identity(channels, channels)),
      Q1(Phi),
      left(r) {}

Window::Window(std::shared_ptr<const Sensor> sensor, int length, Linearisation where, bool as_printed)
    : sensor_(std::move(sensor)), length_(length), where_(where), as_printed_(as_printed) {
  const int p = sensor_->size();
  readings_ = Eigen::MatrixXd::Zero(p, length);
  met_ = Eigen::MatrixXd::Zero(kMaxSmall, length);
  const Eigen::MatrixXd& R = sensor_->noise();
  if (R.isApprox(Eigen::MatrixXd::Identity(p, p) * R(0, 0), 1e-12)) {
    whiten_ = BoundedMatrix::Identity(p, p);
    sigma_ = std::sqrt(R(0, 0));
  } else {
    const Eigen::MatrixXd L = R.llt().matrixL();
    whiten_ = L.inverse();
  }
}

void Window::push(const Eigen::VectorXd& reading, const BoundedVector& prior) {
  readings_.col(next_) = reading;
  met_.col(next_).head(prior.size()) = prior;
  next_ = (next_ + 1) % length_;
  count_ = std::min(count_ + 1, length_);
}

void Window::jacobian(const BoundedVector& x, BoundedMatrix& C) const {
  if (as_printed_) {
    sensor_->jacobian_as_printed(x, C);
  } else {
    sensor_->jacobian(x, C);
  }
}

BoundedVector Window::innovation(int slot, const BoundedVector& point) const {
  BoundedVector r(sensor_->size());
  sensor_->measure(point, r);
  for (Eigen::Index c = 0; c < r.size(); ++c)
    r[c] = wrap(readings_(c, slot) - r[c], sensor_->channels()[static_cast<std::size_t>(c)].period);
  return r;
}

void Window::newest(const BoundedVector& prior, BoundedVector& nu, BoundedMatrix& C) const {
  nu = innovation((next_ + length_ - 1) % length_, prior);
  jacobian(prior, C);
}

/// r_j and C_j of one reading, for the nominal state z at its tick.
void Window::linearise(int slot, const BoundedVector& z, const BoundedMatrix& current, BoundedVector& r,
                       BoundedMatrix& C) const {
  const BoundedVector point = where_ == Linearisation::frozen ? BoundedVector(met_.col(slot).head(z.size())) : z;
  r = innovation(slot, point);
  if (where_ == Linearisation::current) {
    C = current;
  } else {
    jacobian(point, C);
  }
  if (where_ == Linearisation::frozen) r.noalias() += C * (point - z);
}

void Window::regress(const BoundedVector& prior, const Transition& transition, Regression& out) {
  const Eigen::Index n = prior.size(), p = sensor_->size();
  BoundedVector z = prior, r(p), earlier(n);
  BoundedMatrix C(p, n), current(p, n), row(p, n);
  if (where_ == Linearisation::current) jacobian(prior, current);
  for (int j = length_ - 1; j >= 0; --j) {
    linearise(slot_of(j), z, current, r, C);
    row.noalias() = C * transition.power(j);
    out.r.segment(j * p, p) = r;
    out.Phi.middleRows(j * p, p) = row;
    earlier.noalias() = transition.inverse() * z;
    z = earlier;
  }
  out.whiten = whiten_;
  out.sigma = sigma_;
  out.left = out.r;
  if (sigma_ == 1) {  // W may be more than the identity
    for (int j = 0; j < length_; ++j) {
      r.noalias() = whiten_ * out.r.segment(j * p, p);
      out.left.segment(j * p, p) = r;
      row.noalias() = whiten_ * out.Phi.middleRows(j * p, p);
      out.Q1.middleRows(j * p, p) = row;
    }
    out.observable = orthonormalise(out.Q1, out.Q1);
  } else {
    out.observable = orthonormalise(out.Phi, out.Q1);
  }
  for (int pass = 0; pass < 2; ++pass) {
    for (Eigen::Index c = 0; c < n; ++c) out.left -= out.Q1.col(c).dot(out.left) * out.Q1.col(c);
  }
  out.statistic = out.left.norm();
}

bool orthonormalise(const Eigen::MatrixXd& A, Eigen::MatrixXd& Q1) {
  if (&A != &Q1) Q1 = A;
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (Eigen::Index c = 0; c < Q1.cols(); ++c) {
    for (int pass = 0; pass < 2; ++pass) {
      for (Eigen::Index b = 0; b < c; ++b) Q1.col(c) -= Q1.col(b).dot(Q1.col(c)) * Q1.col(b);
    }
    const double pivot = Q1.col(c).norm();
    least = std::min(least, pivot);
    most = std::max(most, pivot);
    if (!(pivot > 0)) return false;
    Q1.col(c) /= pivot;
  }
  return least >= 1e-10 * most;
}

}  // namespace vigil::sparse
