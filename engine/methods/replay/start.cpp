#include "engine/methods/replay/start.hpp"

namespace vigil::replay {
namespace {

Batch make_batch(const System& system) {
  auto batch = Batch::make(system.A, system.B, system.C);
  if (!batch)
    throw InputError("/", "no batch can start the estimator: A is singular, or n readings do not determine the state");
  return *batch;
}

}  // namespace

Start::Start(const System& system)
    : batch_(make_batch(system)),
      Y_(Eigen::MatrixXd::Zero(system.channels(), batch_.length())),
      U_(Eigen::MatrixXd::Zero(system.B.cols(), batch_.length())) {}

std::optional<Eigen::VectorXd> Start::take(const Eigen::VectorXd& input, const Eigen::VectorXd& reading) {
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
