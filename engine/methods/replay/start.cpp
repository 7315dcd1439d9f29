#include "engine/methods/replay/start.hpp"

#include <Eigen/LU>

namespace vigil::replay {
namespace {

Batch make_batch(const System& system) {
  auto batch = Batch::make(system.A, system.B, system.C);
  if (batch) return *batch;
  Eigen::FullPivLU<Eigen::MatrixXd> of_a(system.A);
  of_a.setThreshold(1e-12);
  if (!of_a.isInvertible())
    throw InputError("/", named("A", system.A) +
                              " and is singular, so that no batch can start the estimator; expected an invertible A");
  throw InputError("/", named("C", system.C) + ", and " + std::to_string(system.states()) +
                            " readings do not determine the state, so that no batch can start the estimator; expected "
                            "an observable pair (A, C)");
}

}  // namespace

Start::Start(const System& system)
    : batch_(make_batch(system)),
      Y_(Eigen::MatrixXd::Zero(system.channels(), batch_.length())),
      U_(Eigen::MatrixXd::Zero(system.B.cols(), batch_.length())) {}

std::optional<BoundedVector> Start::take(const Eigen::VectorXd& input, const Eigen::VectorXd& reading) {
  if (!reading.allFinite() || !input.allFinite()) {
    count_ = 0;
    return std::nullopt;
  }
  Y_.col(count_) = reading;
  U_.col(count_) = input;
  if (++count_ < batch_.length()) return std::nullopt;
  count_ = 0;
  return batch_.estimate(Y_, U_);
}

}  // namespace vigil::replay
