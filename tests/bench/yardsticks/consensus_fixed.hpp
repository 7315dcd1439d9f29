/// The bare loop that the consensus lane is measured against: eight nodes, three states, two channels, two to four
/// neighbours, jammed and falsified links, the bounded update of seed 000 with plain fixed-size inverses (four 3x3 and
/// one 2x2 a node), no guard, no records, no interface.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace yardstick {

constexpr int kNodes = 8;
constexpr int kRing = 512;  ///< prerecorded steps; the loop starts again from its initial state after them
constexpr int kMostLinks = 4;

/// Constants for which the unguarded recursion stays bounded over the ring: the cost is that of any others.
constexpr double kSigma = 0.01, kBeta = 0.01, kEps = 0.2, kTau = 0.01, kJammed = 0.1, kFalsified = 0.1, kDelta = 0.2;
constexpr double kOwn = 1.2, kSpeed = 0.05, kTurn = 0.02, kFocalU = 9.0213283 / 2.105, kFocalV = 9.0250141 / 2.105;

inline const std::array<std::vector<int>, kNodes> kNeighbours{
    {{1, 7, 4, 2}, {0, 2, 5}, {1, 3, 6, 0}, {2, 4, 7}, {3, 5, 0, 6}, {4, 6, 1}, {5, 7, 2, 4}, {6, 0, 3}}};
inline const std::array<Eigen::Vector2d, kNodes> kCameras{
    {{0.6, 0.6}, {0.6, 1.8}, {1.2, 1.8}, {1.8, 1.8}, {2.4, 1.8}, {2.4, 1.6}, {1.8, 1.2}, {1.2, 1.2}}};

/// A small deterministic source of inputs.
class Source {
 public:
  explicit Source(std::uint64_t state) : state_(state) {}
  double uniform() {
    state_ = state_ * 6364136223846793005U + 1442695040888963407U;
    return static_cast<double>(state_ >> 11) * 0x1.0p-53;
  }
  double normal() {
    const double radius = std::sqrt(-2 * std::log(1 - uniform()));
    return radius * std::cos(2 * 3.14159265358979323846 * uniform());
  }

 private:
  std::uint64_t state_;
};

struct Inputs {
  std::vector<std::array<Eigen::Vector2d, kNodes>> readings{kRing};
  std::vector<std::array<std::array<std::uint8_t, kMostLinks>, kNodes>> links{
      kRing};  ///< 0 clean, 1 jammed, 2 falsified
  std::vector<Eigen::Vector3d> injected{kRing};
};

inline Eigen::Vector2d seen(const Eigen::Vector3d& x, const Eigen::Vector2d& camera) {
  const double s = std::sin(x[2]), c = std::cos(x[2]), dx = camera[0] - x[0], dy = camera[1] - x[1];
  return {kFocalU * (-dx * s + dy * c - 0.0536) + 347.20436, kFocalV * (-dx * c - dy * s + 0.0668) + 284.3475};
}

inline Inputs record(std::uint64_t seed) {
  Inputs inputs;
  Source source(seed);
  Eigen::Vector3d x(0.4, 0.4, 0.3);
  for (std::size_t k = 0; k < kRing; ++k) {
    x += Eigen::Vector3d(kSpeed * std::cos(x[2]), kSpeed * std::sin(x[2]), kTurn);
    for (std::size_t i = 0; i < kNodes; ++i) {
      const Eigen::Vector2d noise(source.normal(), source.normal());
      inputs.readings[k][i] = seen(x, kCameras[i]) + noise;
      for (auto& link : inputs.links[k][i]) {
        const double u = source.uniform();
        link = u < kJammed ? 1 : u < kJammed + kFalsified ? 2 : 0;
      }
    }
    for (double& entry : inputs.injected[k]) entry = 0.1 * std::sin(source.normal());
  }
  return inputs;
}

class FixedLoop {
 public:
  explicit FixedLoop(const Inputs& inputs) : inputs_(inputs) { restart(); }

  void step() {
    const std::size_t k = next_;
    for (std::size_t i = 0; i < kNodes; ++i) predict(i);
    for (std::size_t i = 0; i < kNodes; ++i) update(i, k);
    next_ = (next_ + 1) % kRing;
    if (next_ == 0) restart();
  }

  double checksum() const {
    double sum = 0;
    for (std::size_t i = 0; i < kNodes; ++i) sum += x_[i].sum() + bound_[i].trace();
    return sum;
  }

 private:
  using Matrix3 = Eigen::Matrix3d;

  void restart() {
    for (std::size_t i = 0; i < kNodes; ++i) {
      x_[i] = {0.4, 0.4, 0.3};
      bound_[i] = 0.1 * Matrix3::Identity();
    }
  }

  void predict(std::size_t i) {
    const double s = std::sin(x_[i][2]), c = std::cos(x_[i][2]);
    Matrix3 F = Matrix3::Identity();
    F(0, 2) = -kSpeed * s;
    F(1, 2) = kSpeed * c;
    predicted_[i] = x_[i] + Eigen::Vector3d(kSpeed * c, kSpeed * s, kTurn);
    const Matrix3 inner = bound_[i].inverse() - (1 + kEps) * kSigma * Matrix3::Identity();
    ahead_[i] = F * inner.inverse() * F.transpose() + UU_ * (1 / (kEps * kSigma)) + Q_;
  }

  void update(std::size_t i, std::size_t k) {
    Eigen::Vector3d pull = Eigen::Vector3d::Zero();
    Matrix3 around = Matrix3::Zero();
    int live = 0;
    const auto degree = static_cast<int>(kNeighbours[i].size());
    for (int l = 0; l < degree; ++l) {
      const auto j = static_cast<std::size_t>(kNeighbours[i][static_cast<std::size_t>(l)]);
      around += ahead_[j];
      const std::uint8_t state = inputs_.links[k][i][static_cast<std::size_t>(l)];
      if (state == 1) continue;
      ++live;
      pull += predicted_[j] - predicted_[i];
      if (state == 2) pull += inputs_.injected[k];
    }
    const Eigen::Vector3d& x = predicted_[i];
    const double s = std::sin(x[2]), c = std::cos(x[2]), dx = kCameras[i][0] - x[0], dy = kCameras[i][1] - x[1];
    Eigen::Matrix<double, 2, 3> H;
    H << kFocalU * s, -kFocalU * c, kFocalU * (-dx * c - dy * s), kFocalV * c, kFocalV * s, kFocalV * (dx * s - dy * c);
    const Matrix3 C = kTau * ahead_[i];
    const Matrix3 inner = ahead_[i].inverse() - kBeta * Matrix3::Identity();
    const Matrix3 M = inner.inverse();
    const Matrix3 B = Matrix3::Identity() - live * C;
    const Eigen::Matrix<double, 3, 2> MHt = M * H.transpose();
    const Eigen::Matrix2d S = H * MHt + VV_ * (1 / kBeta) + R_ * (1 / kOwn);
    const Eigen::Matrix<double, 3, 2> K = B * MHt * S.inverse();
    const Matrix3 G = B - K * H;
    const Eigen::Matrix2d noise = VV_ * (kOwn / kBeta) + R_;
    bound_[i] = kOwn * (G * M * G.transpose()) +
                C * (3 * (1 - kJammed) * around + (3 * degree * kDelta * kDelta * kFalsified) * Matrix3::Identity()) *
                    C.transpose() +
                K * noise * K.transpose();
    x_[i] = x + K * (inputs_.readings[k][i] - seen(x, kCameras[i])) + C * pull;
  }

  const Inputs& inputs_;
  std::size_t next_ = 0;
  std::array<Eigen::Vector3d, kNodes> x_, predicted_;
  std::array<Matrix3, kNodes> bound_, ahead_;
  const Matrix3 Q_ = 0.002 * Matrix3::Identity(), UU_ = 0.005 * 0.005 * Matrix3::Identity();
  const Eigen::Matrix2d R_ = Eigen::Matrix2d::Identity(), VV_ = 0.01 * 0.01 * Eigen::Matrix2d::Identity();
};

}  // namespace yardstick
