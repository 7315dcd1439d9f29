#include "engine/run/fusion_side.hpp"

#include <cmath>

#include "engine/core/missing.hpp"
#include "engine/methods/privacy/confidentiality.hpp"
#include "engine/metrics/lane_score.hpp"
#include "engine/run/lane_scope.hpp"

namespace vigil {
namespace {

constexpr std::size_t kLegitimate = 0, kOptimal = 1, kFirstListener = 2;

/// NaN where an index would be infinite: a frame has no infinity.
double index_of(double eavesdropper, double legitimate) {
  const double index = privacy::confidentiality_index(eavesdropper, legitimate);
  return std::isfinite(index) ? index : kMissing;
}

void write(const double* from, int count, int slot, std::span<double> values) {
  for (int c = 0; c < count; ++c) values[static_cast<std::size_t>(slot + c)] = from[c];
}

}  // namespace

FusionSide::FusionSide(const FusionMethod& method, std::string lane, const std::vector<std::string>& outputs,
                       const Plant& plant, std::optional<std::int64_t> last)
    : lane_(std::move(lane)),
      names_(outputs),
      nodes_(static_cast<int>(outputs.size()) - 1),
      states_(plant.states()),
      sent_(Eigen::MatrixXd::Constant(states_, nodes_, kMissing)),
      heard_(sent_),
      hears_(static_cast<std::size_t>(nodes_), 0) {
  for (const Component& component : plant.state()) periods_.push_back(component.period);
  names_.emplace_back("optimal");
  add_curve("legitimate", "", "", last);
  add_curve("optimal", "", "", last);
  for (const std::string& variant : method.protection().eavesdroppers()) {
    listeners_.push_back({variant, method.protection().eavesdropper(variant)});
    names_.push_back("eve." + variant);
    add_curve("eavesdropper", "", variant, last);
  }
  for (const char* name : {"local", "sent", "compensated"}) {
    for (int i = 0; i < nodes_; ++i) add_curve(name, outputs[static_cast<std::size_t>(i)], "", last);
  }
}

FusionSide::FusionSide(const FusionSide& other)
    : lane_(other.lane_),
      names_(other.names_),
      nodes_(other.nodes_),
      states_(other.states_),
      periods_(other.periods_),
      sent_(other.sent_),
      heard_(other.heard_),
      hears_(other.hears_),
      curves_(other.curves_),
      sent_slots_(other.sent_slots_),
      compensated_slots_(other.compensated_slots_),
      optimal_slot_(other.optimal_slot_),
      ci_(other.ci_),
      rank_(other.rank_),
      ci_mse_(other.ci_mse_) {
  for (const Listener& one : other.listeners_)
    listeners_.push_back({one.variant, one.who->clone(), one.estimate, one.ci, one.ci_mse});
}

void FusionSide::add_curve(const std::string& name, const std::string& node, const std::string& variant,
                           std::optional<std::int64_t> last) {
  curves_.push_back({name, node, variant, -1, -1, kMissing, SquareTally(last)});
}

void FusionSide::declare(const Plant& plant, Catalogue& catalogue) {
  LaneScope scope(lane_, names_, catalogue);
  const auto scalar = [&](int output, const std::string& name) {
    return scope.add(output, name, "", SignalKind::scalar);
  };
  const auto state = [&](int output, const std::string& prefix) {
    const int first = catalogue.size();
    for (const Component& c : plant.state()) scope.add(output, prefix + c.name, c.unit, SignalKind::scalar);
    return first;
  };
  const auto curve = [&](std::size_t place, int output, const std::string& prefix) {
    curves_[place].square = scalar(output, prefix + "square");
    if (prefix != "sent_") curves_[place].trace = scalar(output, prefix + "trace");
  };
  const int fused = nodes_, optimal = nodes_ + 1;
  curve(kLegitimate, fused, "");
  optimal_slot_ = state(optimal, "estimate.");
  curve(kOptimal, optimal, "");
  for (std::size_t v = 0; v < listeners_.size(); ++v) {
    const int output = optimal + 1 + static_cast<int>(v);
    listeners_[v].estimate = state(output, "estimate.");
    curve(kFirstListener + v, output, "");
    listeners_[v].ci = scalar(output, "ci");
    listeners_[v].ci_mse = scalar(output, "ci_mse");
  }
  std::size_t place = kFirstListener + listeners_.size();
  for (const char* prefix : {"", "sent_", "compensated_"}) {
    for (int i = 0; i < nodes_; ++i) curve(place++, i, prefix);
  }
  for (int i = 0; i < nodes_; ++i) {
    sent_slots_.push_back(state(i, "sent."));
    compensated_slots_.push_back(state(i, "compensated."));
  }
  ci_ = scalar(-1, "ci");
  rank_ = scope.add_category(-1, "rank", {"low", "relatively low", "medium", "relatively high", "high"});
  ci_mse_ = scalar(-1, "ci_mse");
}

void FusionSide::listen(const FusionMethod& method, const Eigen::MatrixXd& messages, std::span<const char> overheard) {
  sent_ = messages;
  heard_ = messages;
  for (int i = 0; i < nodes_; ++i) {
    const auto node = static_cast<std::size_t>(i);
    hears_[node] = overheard[node] != 0 && method.protection().audible(i) ? 1 : 0;
    if (hears_[node] == 0) heard_.col(i).setConstant(kMissing);
  }
  const Eigen::VectorXd* published = method.protection().published();
  for (Listener& one : listeners_) {
    if (published != nullptr) one.who->see(method.public_tick(), *published);
    one.who->listen(method.public_tick(), heard_, hears_);
  }
}

double FusionSide::square(const Eigen::VectorXd& truth, const double* estimate) const {
  if (estimate == nullptr || !truth.allFinite()) return kMissing;
  return state_error(truth, estimate, periods_).squaredNorm();
}

void FusionSide::put(Curve& curve, std::int64_t k, double square, double trace, std::span<double> values) {
  curve.tally.add(k, square);
  curve.value = trace;
  values[static_cast<std::size_t>(curve.square)] = square;
  if (curve.trace >= 0) values[static_cast<std::size_t>(curve.trace)] = trace;
}

void FusionSide::publish(std::int64_t k, const FusionMethod& method, const Method& beliefs,
                         const Eigen::VectorXd& truth, std::span<double> values) {
  put(curves_[kLegitimate], k, square(truth, beliefs.belief(nodes_).mean), method.legitimate_trace(), values);
  put(curves_[kOptimal], k, square(truth, method.optimal().data()), method.optimal_trace(), values);
  write(method.optimal().data(), states_, optimal_slot_, values);
  for (std::size_t v = 0; v < listeners_.size(); ++v) {
    const Eigen::VectorXd& estimate = listeners_[v].who->estimate();
    const double trace = method.protection().eavesdropper_trace(method.public_tick(), listeners_[v].variant);
    put(curves_[kFirstListener + v], k, square(truth, estimate.data()), trace, values);
    write(estimate.data(), states_, listeners_[v].estimate, values);
  }
  publish_nodes(k, method, beliefs, truth, values);
  publish_indices(values);
}

void FusionSide::publish_nodes(std::int64_t k, const FusionMethod& method, const Method& beliefs,
                               const Eigen::VectorXd& truth, std::span<double> values) {
  Curve* local = curves_.data() + kFirstListener + listeners_.size();
  for (int i = 0; i < nodes_; ++i, ++local) {
    const auto node = static_cast<std::size_t>(i);
    const Belief belief = beliefs.belief(i);
    double trace = 0;
    for (int c = 0; c < states_; ++c) trace += belief.covariance[c * states_ + c];
    put(*local, k, square(truth, belief.mean), trace, values);
    const double* sent = sent_.col(i).data();
    put(local[nodes_], k, square(truth, sent), kMissing, values);
    write(sent, states_, sent_slots_[node], values);
    const double* compensated = method.compensated(i);
    put(local[2 * nodes_], k, square(truth, compensated), method.compensated_trace(i), values);
    if (compensated != nullptr) write(compensated, states_, compensated_slots_[node], values);
  }
}

void FusionSide::publish_indices(std::span<double> values) {
  const Curve& user = curves_[kLegitimate];
  for (std::size_t v = 0; v < listeners_.size(); ++v) {
    const Curve& eve = curves_[kFirstListener + v];
    const double ci = index_of(eve.value, user.value), pooled = index_of(eve.tally.sum(), user.tally.sum());
    values[static_cast<std::size_t>(listeners_[v].ci)] = ci;
    values[static_cast<std::size_t>(listeners_[v].ci_mse)] = pooled;
    if (v > 0) continue;
    values[static_cast<std::size_t>(ci_)] = ci;
    values[static_cast<std::size_t>(ci_mse_)] = pooled;
    const double ranked = std::isfinite(ci) ? ci : pooled;
    if (std::isfinite(ranked))
      values[static_cast<std::size_t>(rank_)] = static_cast<double>(privacy::confidentiality_rank(ranked));
  }
}

void FusionSide::append_metrics(std::vector<MetricValue>& metrics) const {
  const auto add = [&](const std::string& node, const std::string& name, const std::string& variant, double value) {
    if (std::isfinite(value)) metrics.push_back({lane_, node, name, variant, value, false});
  };
  for (const Curve& curve : curves_) {
    add(curve.node, "mse_" + curve.name, curve.variant, curve.tally.now());
    add(curve.node, "mse_" + curve.name + "_mean", curve.variant, curve.tally.late_mean());
  }
  const Curve& user = curves_[kLegitimate];
  for (std::size_t v = 0; v < listeners_.size(); ++v) {
    const Curve& eve = curves_[kFirstListener + v];
    add("", "ci", eve.variant, index_of(eve.value, user.value));
    add("", "ci_mse", eve.variant, index_of(eve.tally.late_mean(), user.tally.late_mean()));
  }
}

void FusionSide::append_ratios(std::vector<RatioRecord>& ratios) const {
  const double user = curves_[kLegitimate].tally.late_mean();
  for (std::size_t v = 0; v < listeners_.size(); ++v) {
    const double eve = curves_[kFirstListener + v].tally.late_mean();
    if (std::isfinite(eve) && std::isfinite(user))
      ratios.push_back({lane_, "ci_mse", listeners_[v].variant, eve, user});
  }
}

Json FusionSide::traces() const {
  const auto number = [](double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); };
  Json eavesdroppers = Json::object();
  for (std::size_t v = 0; v < listeners_.size(); ++v)
    eavesdroppers[listeners_[v].variant] = number(curves_[kFirstListener + v].value);
  return {{"trace_legitimate", number(curves_[kLegitimate].value)},
          {"trace_optimal", number(curves_[kOptimal].value)},
          {"trace_eavesdropper", std::move(eavesdroppers)}};
}

}  // namespace vigil
