/// The local filters of a fusion lane, each on its own sensor and on the run's plant, and how their errors are
/// correlated. Seed 004, (2-4)-(2-11), (3-7)-(3-9); specification (privacy), section 1.3.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/linalg/small.hpp"
#include "engine/methods/method.hpp"
#include "engine/methods/privacy/protection.hpp"

namespace vigil::privacy {

enum class LocalKind : std::uint8_t {
  extended,      ///< linearised at its own estimate
  time_varying,  ///< of a linear plant
  stationary,    ///< of a linear plant, with the gain that it has in the long run from the first tick on
};

class LocalBank {
 public:
  /// Throws InputError (pointer "/filter") where plant or sensors do not allow this kind or the stationary start.
  /// printed: sensors are linearised as their source prints it.
  LocalBank(LocalKind kind, bool printed, const Knowledge& knowledge);

  /// Tick 0. Weights are I/L where all start alike.
  PublicTick begin();
  /// The next tick: sets its number and input and, where the plant is linearised, every step's A.
  void predict(const Eigen::VectorXd& input, PublicTick& tick);
  /// A channel that gave nothing is left out; where none did the prediction stands. False where it cannot go on, which
  /// is reported.
  bool measure(const Readings& readings, PublicTick& tick, FaultReport& report);

  const Eigen::MatrixXd& means() const { return means_; }  ///< states x sensors
  Belief belief(int sensor) const;

 private:
  struct Node {
    Eigen::MatrixXd steady;  ///< gain of the stationary filter, n x m; else empty
    BoundedVector r;         ///< innovation, 0 where a channel gave nothing
    int read[kMaxSmall];     ///< the channels that gave something
    int count = 0;
    BoundedVector innovation;  ///< of those channels, and its covariance
    BoundedMatrix S, covariance;
  };

  void fill(const Knowledge& knowledge);
  bool complete() const;  ///< every channel was read
  void innovate(std::size_t i, const Eigen::VectorXd& reading);
  void solve(std::size_t i, PublicTick& tick, FaultReport& report);
  bool finish(const PublicTick& tick, FaultReport& report) const;
  void keep_covariances(const Eigen::MatrixXd& P);

  LocalKind kind_;
  bool printed_;
  std::shared_ptr<const Plant> plant_;
  std::vector<std::shared_ptr<const Sensor>> sensors_;
  std::vector<std::string> ids_;
  Eigen::MatrixXd Q_, start_, means_, before_;
  std::vector<LocalStep> steps_;
  std::vector<Node> nodes_;
  bool frozen_ = false;  ///< covariances, gains and weights no longer move
};

}  // namespace vigil::privacy
