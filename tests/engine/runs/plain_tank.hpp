/// The two tanks under replay once more: plainly, in one loop of dense matrices, from the specification (replay),
/// sections 2 to 6, with the draws of a run and nothing else of it.
#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "engine/world/noise.hpp"
#include "tests/engine/methods/replay/tank.hpp"

namespace vigil::test::plain {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

inline constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

/// A row of the table in section 7.
struct Profile {
  const char* id;
  bool monitor = false, innovation = false;
  bool capped = false;  ///< zeta_max 1, else infinity
  bool frozen = false;
  char watermark = '-';  ///< 's'ensor, 'c'ontrol
  double amplitude = 0;
  bool patient = false;    ///< tau 40, eta 3 instead of the scenario's
  const char* fixed = "";  ///< "norm", "square"
};

inline const std::vector<Profile>& profiles() {
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

/// What leaves one tick.
struct Row {
  Vector truth, input, arrived, sent, estimate, residual;
  Matrix covariance, shape;
  double statistic = kMissing, threshold = kMissing;
  bool alarm = false;
};

/// Section 5, from a list of all statistics so far.
class Detector {
 public:
  Detector(const Profile& profile, const replay::tank::Scenario& scenario)
      : profile_(profile),
        tau_(profile.patient ? 40 : scenario.tau),
        eta_(profile.patient ? 3 : scenario.eta),
        iota_(scenario.iota) {}

  void judge(int k, const Vector& residual, Row& row) {
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

 private:
  void follow() {
    const auto tau = static_cast<std::size_t>(tau_);
    if (window_.size() < tau) return;
    const Eigen::Map<const Vector> last(window_.data() + (window_.size() - tau), tau_);
    const double mean = last.mean();
    const double next = mean + eta_ * std::sqrt((last.array() - mean).square().sum() / (tau_ - 1));
    if (std::isnan(threshold_) || std::abs(next - threshold_) >= iota_) threshold_ = next;
  }

  const Profile& profile_;
  int tau_;
  double eta_, iota_;
  std::vector<double> energies_, window_;
  double threshold_ = kMissing, largest_ = 0;
  bool flagged_ = false;
};

/// The feedback gain: the Riccati equation iterated until it stands still.
inline Matrix feedback() {
  const Matrix &A = replay::tank::A, &B = replay::tank::B;
  Matrix S = Matrix::Identity(2, 2);
  for (int i = 0; i < 5000; ++i)
    S = A.transpose() * S * A -
        A.transpose() * S * B * (B.transpose() * S * B + Matrix::Identity(1, 1)).inverse() * B.transpose() * S * A +
        Matrix::Identity(2, 2);
  return -(B.transpose() * S * B + Matrix::Identity(1, 1)).inverse() * B.transpose() * S * A;
}

inline Matrix least_trace(const std::vector<Matrix>& operands) {
  Matrix sum = Matrix::Zero(operands[0].rows(), operands[0].cols());
  double reach = 0;
  for (const Matrix& E : operands) {
    if (E.trace() < 1e-20) continue;
    reach += std::sqrt(E.trace());
    sum += E / std::sqrt(E.trace());
  }
  return reach * sum;
}

/// Sections 4.3 to 4.5 with the gains that are optimal in the three scenarios: Kalman's for mu = 1, zeta = 1 where zeta
/// is capped, C^-1 elsewhere.
class Estimator {
 public:
  Estimator(const Profile& profile, const replay::tank::Scenario& scenario)
      : capped_(profile.capped), scenario_(scenario), P_(scenario.noise()), M0_(scenario.bounded()) {}

  bool ready() const { return k_ >= 2; }
  Vector x, predicted;
  Matrix Q, M;

  void take(const Vector& u, const Vector& y) {
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

 private:
  /// The state that fits the first two readings best: y_1 = C A^-1 (x_2 - B u_1 - w - d) + v + f, y_2 = C x_2 + v + f.
  void begin(const Vector& u, const Vector& y) {
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

  void update(const Matrix& Qp, const Matrix& Mp) {
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

  bool capped_;
  replay::tank::Scenario scenario_;
  Matrix P_, M0_, K_;
  Vector first_;
  int k_ = 0;
};

struct Attack {
  int start = 101, end = 180;
  bool active(int k) const { return k >= start && k <= end; }
  int source(int k) const { return 50 + (k - start) % 51; }
};

/// Ticks 0 to `steps` under gmix and uniform noise.
inline std::vector<Row> simulate(const Profile& profile, const replay::tank::Scenario& scenario, std::uint64_t seed,
                                 const Attack& attack, int steps = 300) {
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
