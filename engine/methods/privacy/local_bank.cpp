#include "engine/methods/privacy/local_bank.hpp"

#include <fmt/format.h>

#include <cmath>

#include "engine/core/input_error.hpp"
#include "engine/linalg/riccati.hpp"
#include "engine/methods/privacy/local_filters.hpp"
#include "engine/methods/privacy/start.hpp"

namespace vigil::privacy {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

StationaryFilters solved(const FusionModel& model, const std::vector<std::string>& ids) {
  for (std::size_t i = 0; i < model.sensors.size(); ++i) {
    if (detectable(model.A, model.sensors[i].C)) continue;
    throw InputError("/filter",
                     fmt::format("sensor {} does not see a mode of the plant that does not decay; expected a "
                                 "detectable pair (A, C) at every sensor",
                                 ids[i]));
  }
  auto filters = stationary_filters(model);
  if (!filters)
    throw InputError("/filter",
                     "the local filters have no stationary law: the process noise does not reach a mode of the plant "
                     "that does not decay");
  return std::move(*filters);
}

}  // namespace

LocalBank::LocalBank(LocalKind kind, bool printed, const Knowledge& knowledge)
    : kind_(kind),
      printed_(printed),
      plant_(knowledge.plant),
      sensors_(knowledge.sensors),
      ids_(knowledge.nodes),
      Q_(knowledge.Q),
      means_(knowledge.estimates),
      nodes_(sensors_.size()) {
  bool linear = plant_->linear();
  for (const auto& sensor : sensors_) linear = linear && sensor->linear();
  if (!linear && kind != LocalKind::extended)
    throw InputError("/filter", "this filter needs a linear plant and linear sensors", "extended");
  if (!linear && knowledge.stationary)
    throw InputError("/filter", "a start in the stationary law needs a linear plant and linear sensors");
  std::optional<StationaryFilters> filters;
  if (knowledge.stationary || kind == LocalKind::stationary) filters = solved(fusion_model(knowledge), ids_);
  start_ = start_covariance(knowledge, knowledge.stationary ? &*filters : nullptr);
  for (std::size_t i = 0; kind == LocalKind::stationary && i < nodes_.size(); ++i)
    nodes_[i].steady = filters->gains[i].K;
  fill(knowledge);
}

/// Every matrix of a tick gets its size, and those of a linear plant their values.
void LocalBank::fill(const Knowledge& knowledge) {
  const int n = plant_->states();
  const VectorXd origin = prior_mean(knowledge);
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const int m = sensors_[i]->size();
    LocalStep step{.A = MatrixXd(n, n), .C = MatrixXd(m, n), .R = sensors_[i]->noise()};
    plant_->jacobian(origin, VectorXd::Zero(plant_->inputs()), step.A);
    sensors_[i]->jacobian(origin, step.C);
    steps_.push_back(std::move(step));
    nodes_[i].r.resize(m);
  }
  keep_covariances(start_);
}

PublicTick LocalBank::begin() {
  PublicTick tick;
  tick.P = start_;
  tick.nominal = fuse(start_, plant_->states());
  return tick;
}

void LocalBank::predict(const VectorXd& input, PublicTick& tick) {
  ++tick.k;
  tick.input = input;
  if (tick.steps.empty()) {
    tick.steps = steps_;
    tick.gains.resize(nodes_.size());
  }
  BoundedVector next(means_.rows());
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    if (kind_ == LocalKind::extended) plant_->jacobian(means_.col(column), input, tick.steps[i].A);
    plant_->advance(means_.col(column), input, next);
    means_.col(column) = next;
  }
}

bool LocalBank::measure(const Readings& readings, PublicTick& tick, FaultReport& report) {
  for (std::size_t i = 0; i < nodes_.size(); ++i) innovate(i, readings[i]);
  tick.settled = frozen_ && complete();
  if (!tick.settled) {
    for (std::size_t i = 0; i < nodes_.size(); ++i) solve(i, tick, report);
    before_ = tick.P;
    step_errors(tick.steps, tick.gains, Q_, tick.P);
    if (!tick.P.allFinite()) return finish(tick, report);
    tick.nominal = fuse(tick.P, static_cast<int>(means_.rows()));
    keep_covariances(tick.P);
    frozen_ = kind_ != LocalKind::extended && complete() && settled(tick.P, before_);
  }
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    means_.col(static_cast<Eigen::Index>(i)).noalias() += tick.gains[i].K * nodes_[i].r;
  return finish(tick, report);
}

bool LocalBank::complete() const {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (nodes_[i].count != sensors_[i]->size()) return false;
  }
  return true;
}

void LocalBank::innovate(std::size_t i, const VectorXd& reading) {
  Node& node = nodes_[i];
  const Sensor& sensor = *sensors_[i];
  sensor.measure(means_.col(static_cast<Eigen::Index>(i)), node.r);
  node.count = 0;
  for (int c = 0; c < sensor.size(); ++c) {
    const bool given = std::isfinite(reading[c]);
    if (given) node.read[node.count++] = c;
    node.r[c] = given ? wrap(reading[c] - node.r[c], sensor.channels()[static_cast<std::size_t>(c)].period) : 0;
  }
  node.innovation.resize(node.count);
  for (int c = 0; c < node.count; ++c) node.innovation[c] = node.r[node.read[c]];
}

/// This tick's gain of a sensor, from the channels that were read, and its innovation's covariance.
void LocalBank::solve(std::size_t i, PublicTick& tick, FaultReport& report) {
  Node& node = nodes_[i];
  LocalStep& step = tick.steps[i];
  const auto n = means_.rows();
  const auto at = static_cast<Eigen::Index>(i) * n;
  if (kind_ == LocalKind::extended) {
    const auto mean = means_.col(static_cast<Eigen::Index>(i));
    printed_ ? sensors_[i]->jacobian_as_printed(mean, step.C) : sensors_[i]->jacobian(mean, step.C);
    if (std::string* text =
            sensors_[i]->limited(mean) ? report.fault(static_cast<int>(i), "singular_geometry") : nullptr)
      *text = fmt::format("sensor {}: the estimate stands where a bearing has no direction; its derivative was limited",
                          ids_[i]);
  }
  const MatrixXd Pz = step.A * tick.P.block(at, at, n, n) * step.A.transpose() + Q_;
  MatrixXd C(node.count, n), R(node.count, node.count);
  for (int a = 0; a < node.count; ++a) {
    C.row(a) = step.C.row(node.read[a]);
    for (int b = 0; b < node.count; ++b) R(a, b) = step.R(node.read[a], node.read[b]);
  }
  node.S = C * Pz * C.transpose() + R;
  MatrixXd& K = tick.gains[i].K;
  K.setZero(n, step.C.rows());
  if (node.count > 0 && node.steady.size() > 0) {
    for (int a = 0; a < node.count; ++a) K.col(node.read[a]) = node.steady.col(node.read[a]);
  } else if (node.count > 0) {
    if (const auto gains = local_gains(Pz, C, R)) {
      for (int a = 0; a < node.count; ++a) K.col(node.read[a]) = gains->K.col(a);
    } else {
      node.count = 0;
      if (std::string* text = report.fault(static_cast<int>(i), "update_failed"))
        *text = fmt::format("sensor {}: the innovation's covariance is not positive definite; the prediction stands",
                            ids_[i]);
    }
  }
  tick.gains[i].F = MatrixXd::Identity(n, n) - K * step.C;
}

bool LocalBank::finish(const PublicTick& tick, FaultReport& report) const {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (means_.col(static_cast<Eigen::Index>(i)).allFinite()) continue;
    if (std::string* text = report.stop(static_cast<int>(i), "diverged"))
      *text = fmt::format("sensor {}: the local estimate is no longer finite", ids_[i]);
    return false;
  }
  if (tick.P.allFinite() && tick.nominal.W.allFinite()) return true;
  if (std::string* text = report.stop(static_cast<int>(nodes_.size()), "diverged"))
    *text = "the covariance of the local errors is no longer finite";
  return false;
}

void LocalBank::keep_covariances(const MatrixXd& P) {
  const auto n = means_.rows();
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i) * n;
    nodes_[i].covariance = P.block(at, at, n, n);
  }
}

Belief LocalBank::belief(int sensor) const {
  const Node& node = nodes_[static_cast<std::size_t>(sensor)];
  Belief belief{.mean = means_.col(sensor).data(), .covariance = node.covariance.data()};
  if (node.count > 0) {
    belief.innovation = node.innovation.data();
    belief.innovation_covariance = node.S.data();
    belief.innovation_size = node.count;
  }
  return belief;
}

}  // namespace vigil::privacy
