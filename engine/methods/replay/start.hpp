/// Collects readings until a batch can start an estimator. Specification of seed 003, section 4.3.
#pragma once

#include <optional>

#include "engine/methods/replay/batch.hpp"
#include "engine/methods/replay/system.hpp"

namespace vigil::replay {

class Start {
 public:
  /// Throws InputError where no batch can start.
  explicit Start(const System& system);

  /// One tick: the input that acted since the last one, and the reading; a reading that is not finite starts the count
  /// again. The estimate once n good ones are there in a row.
  std::optional<BoundedVector> take(const Eigen::VectorXd& input, const Eigen::VectorXd& reading);

  const Batch& batch() const { return batch_; }

 private:
  Batch batch_;
  Eigen::MatrixXd Y_, U_;  ///< channels x n, inputs x n
  int count_ = 0;
};

}  // namespace vigil::replay
