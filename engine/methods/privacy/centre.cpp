#include "engine/methods/privacy/centre.hpp"

#include <cmath>
#include <limits>

#include "engine/linalg/small.hpp"
#include "engine/methods/privacy/local_filters.hpp"
#include "engine/methods/privacy/start.hpp"

namespace vigil::privacy {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

}  // namespace

void to_turn_of(const Eigen::Ref<const VectorXd>& anchor, const std::vector<double>& periods,
                Eigen::Ref<VectorXd> estimate) {
  for (std::size_t c = 0; c < periods.size(); ++c) {
    const auto at = static_cast<Eigen::Index>(c);
    const double off = estimate[at] - anchor[at];
    if (periods[c] != 0 && std::abs(off) > periods[c] / 2) estimate[at] = anchor[at] + wrap(off, periods[c]);
  }
}

std::vector<double> periods_of(const Plant& plant) {
  std::vector<double> periods;
  for (const Component& component : plant.state()) periods.push_back(component.period);
  return periods;
}

Centre::Centre(const Knowledge& knowledge, const PublicTick& start)
    : plant_(knowledge.plant),
      periods_(periods_of(*plant_)),
      Q_(knowledge.Q),
      Af_(plant_->states(), plant_->states()),
      prior_(prior_foresight(knowledge, start.P)),
      mean_(prior_mean(knowledge)),
      predicted_(mean_),
      h_(Eigen::VectorXd::Constant(start.P.rows(), -1)),
      compensated_(knowledge.estimates) {
  user_.P = prior_.P;
}

bool Centre::take(const PublicTick& tick, const Decoded& decoded, const Protection& protection) {
  if (decoded.fused) {
    mean_ = decoded.mean;
    user_.P = decoded.P;
    return mean_.allFinite();
  }
  predict(tick);
  compensate(decoded);
  if (!steady_ || !tick.settled || decoded.h != h_) weigh(tick, decoded.h, protection);
  mean_.noalias() = user_.Wf * compensated_.reshaped();
  return mean_.allFinite();
}

/// What the centre expects before it has looked at the messages: at tick 0 what everybody does.
void Centre::predict(const PublicTick& tick) {
  if (tick.k == 0) return;
  BoundedVector next(mean_.size());
  plant_->advance(mean_, tick.input, next);
  if (!plant_->linear()) plant_->jacobian(mean_, tick.input, Af_);
  predicted_ = next;
}

void Centre::compensate(const Decoded& decoded) {
  const auto n = predicted_.size();
  for (Eigen::Index i = 0; i < compensated_.cols(); ++i) {
    for (Eigen::Index c = 0; c < n; ++c) {
      const bool kept = decoded.h[i * n + c] != 0;
      compensated_(c, i) = kept ? decoded.estimates(c, i) : predicted_[c];
      replaced_ = replaced_ || !kept;
    }
    to_turn_of(predicted_, periods_, compensated_.col(i));
  }
}

void Centre::weigh(const PublicTick& tick, const VectorXd& h, const Protection& protection) {
  const bool same = tick.settled && h == h_;
  h_ = h;
  const MatrixXd noise = protection.noise();
  if (noise.size() == 0 && h.minCoeff() == 1) {
    user_ = {.Wf = tick.nominal.W, .P = tick.nominal.P, .X = tick.nominal.W * tick.P, .S = tick.P};
    steady_ = tick.settled;
    return;
  }
  const MatrixXd P_before = user_.P, X_before = user_.X;
  if (tick.k > 0 && plant_->linear()) Af_ = tick.steps.front().A;
  take_in(tick.P, tick.k == 0 ? prior_ : foresee(tick.steps, tick.gains, Q_, Af_, user_), h, noise, user_);
  steady_ = same && settled(user_.P, P_before) && settled(user_.X, X_before);
}

const double* Centre::compensated(int sensor) const { return replaced_ ? compensated_.col(sensor).data() : nullptr; }

double Centre::compensated_trace(int sensor) const {
  if (!replaced_ || user_.S.size() == 0) return std::numeric_limits<double>::quiet_NaN();
  const auto n = mean_.size();
  return user_.S.block(sensor * n, sensor * n, n, n).trace();
}

}  // namespace vigil::privacy
