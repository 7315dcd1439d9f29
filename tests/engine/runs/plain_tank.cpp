#include "tests/engine/runs/plain_tank.hpp"

namespace vigil::test::plain {

const std::vector<Profile>& profiles() {
  static const std::vector<Profile> all{
      {.id = "as_written"},
      {.id = "innov", .innovation = true},
      {.id = "zeta1", .capped = true},
      {.id = "zeta1_freeze", .capped = true, .frozen = true},
      {.id = "eq29", .monitor = true},
      {.id = "eq29_freeze", .monitor = true, .frozen = true},
      {.id = "zeta1_wm", .capped = true, .watermark = 's', .amplitude = 2},
      {.id = "zeta1_wm_freeze", .capped = true, .frozen = true, .watermark = 's', .amplitude = 2},
      {.id = "repaired", .capped = true, .frozen = true, .watermark = 's', .amplitude = 2, .patient = true},
      {.id = "repaired_ctrl",
       .innovation = true,
       .capped = true,
       .frozen = true,
       .watermark = 'c',
       .amplitude = 4,
       .patient = true},
      {.id = "fixed_norm", .monitor = true, .capped = true, .fixed = "norm"},
      {.id = "fixed_square", .monitor = true, .capped = true, .fixed = "square"}};
  return all;
}

void Detector::judge(int k, const Vector& residual, Row& row) {
  const double energy = residual.squaredNorm() < 1e-14 ? 0 : residual.squaredNorm();
  energies_.push_back(energy);
  if (k >= 3 && k <= 49) largest_ = std::max(largest_, energy);
  if (energies_.size() >= 5) {
    double sum = 0;
    for (std::size_t i = energies_.size() - 5; i < energies_.size(); ++i) sum += energies_[i];
    row.statistic = sum / 5;
  }
  const bool fixed = *profile_.fixed != 0, has_statistic = energies_.size() >= 5;
  if (fixed && k > 49) threshold_ = std::string(profile_.fixed) == "norm" ? std::sqrt(largest_) : largest_;
  if (has_statistic && !profile_.frozen) window_.push_back(row.statistic);
  if (has_statistic && !fixed && !(profile_.frozen && flagged_)) follow();
  flagged_ = has_statistic && row.statistic > threshold_;  // false while there is none
  if (has_statistic && profile_.frozen && !flagged_) window_.push_back(row.statistic);
  row.threshold = threshold_;
  row.alarm = flagged_;
}

void Detector::follow() {
  const auto tau = static_cast<std::size_t>(tau_);
  if (window_.size() < tau) return;
  const Eigen::Map<const Vector> last(window_.data() + (window_.size() - tau), tau_);
  const double mean = last.mean();
  const double next = mean + eta_ * std::sqrt((last.array() - mean).square().sum() / (tau_ - 1));
  if (std::isnan(threshold_) || std::abs(next - threshold_) >= iota_) threshold_ = next;
}

Matrix feedback() {
  const Matrix &A = replay::tank::A, &B = replay::tank::B;
  Matrix S = Matrix::Identity(2, 2);
  for (int i = 0; i < 5000; ++i)
    S = A.transpose() * S * A -
        A.transpose() * S * B * (B.transpose() * S * B + Matrix::Identity(1, 1)).inverse() * B.transpose() * S * A +
        Matrix::Identity(2, 2);
  return -(B.transpose() * S * B + Matrix::Identity(1, 1)).inverse() * B.transpose() * S * A;
}

bool Estimator::ready() const { return k_ >= 2; }

void Estimator::take(const Vector& u, const Vector& y) {
  const Matrix &A = replay::tank::A, &B = replay::tank::B, &C = replay::tank::C;
  ++k_;
  if (k_ == 1) {
    first_ = y;
  } else if (k_ == 2) {
    begin(u, y);
  } else {
    predicted = A * x + B * u;
    const Matrix Qp = A * Q * A.transpose() + P_, Mp = least_trace({A * M * A.transpose(), M0_});
    update(Qp, Mp);
    x = predicted + K_ * (y - C * predicted);
  }
}

void Estimator::begin(const Vector& u, const Vector& y) {
  const Matrix &B = replay::tank::B, &C = replay::tank::C;
  const Matrix back = C * replay::tank::A.inverse();
  Matrix H(4, 2);
  H << back, C;
  Vector Y(4);
  Y << first_ + back * B * u, y;
  const Matrix N = (H.transpose() * H).inverse() * H.transpose();
  x = predicted = N * Y;
  std::vector<Matrix> T{N.leftCols(2) * back, N.leftCols(2), N.rightCols(2)};
  Q = Matrix::Zero(2, 2);
  for (const Matrix& one : T) Q += one * P_ * one.transpose();  // P = R and Mw = Mv here
  for (Matrix& one : T) one = one * M0_ * one.transpose();
  M = least_trace(T);
}

void Estimator::update(const Matrix& Qp, const Matrix& Mp) {
  const Matrix& C = replay::tank::C;
  const double mu = scenario_.mu;
  const bool corner = mu < 1 && !capped_;
  if (corner) {
    K_ = C.inverse();
  } else {
    const Matrix W = mu * Qp + 2 * (1 - mu) * Mp, S = mu * P_ + 2 * (1 - mu) * M0_;
    K_ = W * C.transpose() * (C * W * C.transpose() + S).inverse();
  }
  const Matrix X = Matrix::Identity(2, 2) - K_ * C;
  Q = X * Qp * X.transpose() + K_ * P_ * K_.transpose();
  const Matrix of_prediction = X * Mp * X.transpose(), of_sensor = K_ * M0_ * K_.transpose();
  M = mu == 1 || corner ? least_trace({of_prediction, of_sensor}) : Matrix(2 * of_prediction + 2 * of_sensor);
}

Matrix least_trace(const std::vector<Matrix>& operands) {
  Matrix sum = Matrix::Zero(operands[0].rows(), operands[0].cols());
  double reach = 0;
  for (const Matrix& E : operands) {
    if (E.trace() < 1e-20) continue;
    reach += std::sqrt(E.trace());
    sum += E / std::sqrt(E.trace());
  }
  return reach * sum;
}

std::vector<Row> simulate(const Profile& profile, const replay::tank::Scenario& scenario, std::uint64_t seed,
                          const Attack& attack, int steps) {
  const Matrix &A = replay::tank::A, &B = replay::tank::B, &C = replay::tank::C;
  const NoiseSource process(scenario.noise(), Law::gmix, scenario.bounded(), BoundedLaw::uniform, seed, "plant");
  const NoiseSource sensing(scenario.noise(), Law::gmix, scenario.bounded(), BoundedLaw::uniform, seed, "sensor.1");
  const Draws sensor_key(seed, "watermark.sensor"), control_key(seed, "watermark.control");
  const auto mark = [&](int k) {
    const double a = profile.watermark == 's' ? profile.amplitude : 0;
    return Vector(a * Eigen::Vector2d(sensor_key.normal(k, 0), sensor_key.normal(k, 1)));
  };
  const Matrix L = feedback();
  Estimator estimator(profile, scenario);
  Detector detector(profile, scenario);
  std::vector<Row> rows(static_cast<std::size_t>(steps) + 1);
  rows[0].truth = Vector::Ones(2);
  Vector u, noise(2);
  for (int k = 0; k <= steps; ++k) {
    Row& row = rows[static_cast<std::size_t>(k)];
    if (k > 0) {
      process.draw(k, noise);
      row.input = u;
      row.truth = A * rows[static_cast<std::size_t>(k - 1)].truth + B * u + noise;
      sensing.draw(k, noise);
      row.sent = C * row.truth + noise + mark(k);
      row.arrived = attack.active(k) ? rows[static_cast<std::size_t>(attack.source(k))].sent : row.sent;
      estimator.take(u, (profile.monitor ? row.sent : row.arrived) - mark(k));
    }
    u = estimator.ready() ? Vector(L * estimator.x) : Vector(Vector::Zero(1));
    if (profile.watermark == 'c') u[0] += profile.amplitude * control_key.normal(k, 0);
    if (!estimator.ready()) continue;
    row.estimate = estimator.x;
    row.covariance = estimator.Q;
    row.shape = estimator.M;
    if (k < 3) continue;
    row.residual = row.arrived - mark(k) - C * (profile.innovation ? estimator.predicted : estimator.x);
    detector.judge(k, row.residual, row);
  }
  return rows;
}

}  // namespace vigil::test::plain
