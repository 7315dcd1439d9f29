#include "engine/methods/privacy/start.hpp"

#include "engine/linalg/riccati.hpp"
#include "engine/linalg/small.hpp"
#include "engine/methods/privacy/local_filters.hpp"

namespace vigil::privacy {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The plant's own part of a FusionModel. It must be linear.
FusionModel plant_model(const Knowledge& knowledge) {
  const int n = knowledge.plant->states();
  MatrixXd A(n, n);
  knowledge.plant->jacobian(VectorXd::Zero(n), VectorXd::Zero(knowledge.plant->inputs()), A);
  return {.A = A, .B = MatrixXd::Identity(n, n), .Q = knowledge.Q, .sensors = {}, .x0 = {}, .P0 = {}};
}

/// Covariance of the initial state about its prior mean.
MatrixXd start_of_state(const Knowledge& knowledge) {
  if (knowledge.stationary && knowledge.plant->linear()) {
    if (const auto S = state_covariance(plant_model(knowledge))) return *S;
  }
  return knowledge.P0;
}

bool start_alike(const MatrixXd& estimates) {
  return (estimates.colwise() - estimates.col(0)).cwiseAbs().maxCoeff() == 0;
}

}  // namespace

VectorXd prior_mean(const Knowledge& knowledge) {
  if (knowledge.prior.size() == knowledge.plant->states() && knowledge.prior.allFinite()) return knowledge.prior;
  return knowledge.estimates.rowwise().mean();
}

MatrixXd start_covariance(const Knowledge& knowledge, const StationaryFilters* filters) {
  if (filters) return filters->P;
  const auto count = static_cast<int>(knowledge.sensors.size());
  if (start_alike(knowledge.estimates)) return common_start(knowledge.P0, count);
  return block_diagonal(std::vector<MatrixXd>(static_cast<std::size_t>(count), knowledge.P0));
}

Foresight prior_foresight(const Knowledge& knowledge, const MatrixXd& P) {
  const auto n = knowledge.plant->states();
  const auto count = P.rows() / n;
  Foresight prior{.P = start_of_state(knowledge), .X = MatrixXd::Zero(P.rows(), n)};
  const bool all_random = knowledge.stationary && prior.P.size() > 0 && knowledge.plant->linear() &&
                          spectral_radius(plant_model(knowledge).A) < 1;
  if (knowledge.stationary ? all_random : start_alike(knowledge.estimates)) {
    for (Eigen::Index i = 0; i < count; ++i) prior.X.middleRows(i * n, n) = P.block(i * n, i * n, n, n);
  }
  return prior;
}

StateMoment::StateMoment(const Knowledge& knowledge)
    : plant_(knowledge.plant),
      linear_(plant_->linear()),
      no_input_(VectorXd::Zero(plant_->inputs())),
      mean_(prior_mean(knowledge)),
      Q_(knowledge.Q) {
  if (!linear_) return;
  A_ = plant_model(knowledge).A;
  covariance_ = start_of_state(knowledge);
  second_ = covariance_ + mean_ * mean_.transpose();
}

void StateMoment::step(const VectorXd& input) {
  if (!linear_ || settled_) return;
  const MatrixXd before = second_;
  BoundedVector next(mean_.size());
  plant_->advance(mean_, input.size() > 0 ? input : no_input_, next);
  mean_ = next;
  covariance_ = (A_ * covariance_ * A_.transpose() + Q_).eval();
  symmetrise(covariance_);
  second_ = covariance_ + mean_ * mean_.transpose();
  settled_ = plant_->inputs() == 0 && privacy::settled(second_, before);
}

}  // namespace vigil::privacy
