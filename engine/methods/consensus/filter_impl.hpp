/// Definitions of Filter<N, M>, included once by each instantiation so that they compile side by side.
#pragma once

#include <fmt/format.h>

#include <limits>

#include "engine/methods/consensus/filter.hpp"

namespace vigil::consensus {

template <int N, int M>
Filter<N, M>::Filter(const Params& params, const Knowledge& knowledge)
    : plant_(knowledge.plant),
      sensors_(knowledge.sensors),
      ids_(knowledge.nodes),
      Q_(knowledge.Q),
      graph_(knowledge.graph),
      published_(knowledge.rates),
      states_(knowledge.plant->states()),
      nodes_(knowledge.nodes.size()),
      lost_(knowledge.nodes.size(), 0),
      min_eigenvalue_(std::numeric_limits<double>::infinity()),
      max_eigenvalue_(-std::numeric_limits<double>::infinity()) {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    NodeState& node = nodes_[i];
    node.resize(states_, sensors_[i]->size());
    node.x = knowledge.estimates.col(static_cast<Eigen::Index>(i));
    node.xp = node.x;
    node.Phi = knowledge.P0;
    node.Q = Q_;
    node.R = sensors_[i]->noise();
    decompose(node);
  }
  apply_settings(read_settings(params, states_, graph_, published_));
  held_.resize(graph_.links().size());
  for (std::size_t l = 0; l < held_.size(); ++l) held_[l] = at(graph_.links()[l].from).x;
}

template <int N, int M>
void Filter<N, M>::apply_settings(Settings settings) {
  std::vector<SmallMatrix<M, M>> VV;
  for (const auto& sensor : sensors_) {
    const Eigen::MatrixXd V = settings.raw.square("V", sensor->size());
    VV.push_back(V * V.transpose());
  }
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    nodes_[i].UU = settings.U * settings.U.transpose();
    nodes_[i].VV = VV[i];
  }
  settings_ = std::move(settings);
  rates_ = effective_rates(settings_, published_);
}

template <int N, int M>
void Filter<N, M>::declare(SignalScope& scope) {
  slots_.clear();
  for (int i = 0; i < static_cast<int>(nodes_.size()); ++i) {
    slots_.push_back(
        {scope.add(i, "feasible28", "", SignalKind::boolean), scope.add(i, "feasible29", "", SignalKind::boolean),
         scope.add(i, "lambda_max", "", SignalKind::scalar), scope.add(i, "lost", "", SignalKind::scalar)});
  }
}

template <int N, int M>
void Filter<N, M>::predict(const Eigen::VectorXd& input, FaultReport& report) {
  ++tick_;
  typename NodeState::MatN F(states_, states_);
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    NodeState& node = nodes_[i];
    plant_->jacobian(node.x, input, F);
    plant_->advance(node.x, input, node.xp);  // (3)
    const bool finite = predict_bound(node, F, settings_.constants, graph_.degree(static_cast<int>(i)));
    judge(static_cast<int>(i), report);
    const bool stopped = settings_.constants.guard == Guard::strict && !(node.feasible28 && node.feasible29);
    if (stopped) return;  // a bound at the very limit is infinite as well: the condition is the better word
    if (!finite) {
      if (std::string* text = report.stop(static_cast<int>(i), "diverged")) {
        *text = fmt::format("the prediction bound of node {} is not finite at step {}", ids_[i], tick_);
      }
      return;
    }
  }
}

template <int N, int M>
void Filter<N, M>::judge(int index, FaultReport& report) {
  const NodeState& node = at(index);
  if (node.feasible28 && node.feasible29) return;
  if (first_infeasible_ == 0) first_infeasible_ = tick_;
  const bool strict = settings_.constants.guard == Guard::strict;
  const auto tell = [&](const char* code, const char* condition, double least, double largest, double limit) {
    std::string* text = strict ? report.stop(index, code) : report.fault(index, code);
    if (text == nullptr) return;
    *text = fmt::format("condition {} fails at node {}, step {}: ", condition, ids_[static_cast<std::size_t>(index)],
                        tick_);
    *text += largest >= limit ? fmt::format("largest eigenvalue {:.6g}, limit {:.6g}", largest, limit)
                              : fmt::format("smallest eigenvalue {:.6g}, which must be above 0", least);
  };
  const auto last = node.phi_values.size() - 1;
  if (!node.feasible28)
    tell("infeasible_28", "(28)", node.phi_values[0], node.phi_values[last], settings_.constants.limit28());
  if (strict && !node.feasible28) return;  // without a guard (29) fails in its wake
  if (!node.feasible29)
    tell("infeasible_29", "(29)", node.least_predicted, node.lambda_predicted, settings_.constants.limit29());
}

template <int N, int M>
Received<N> Filter<N, M>::receive(int index, std::span<const Delivery> inbox) {
  const NodeState& node = at(index);
  Received<N> received;
  received.pull.setZero(states_);
  received.neighbours.setZero(states_, states_);
  lost_[static_cast<std::size_t>(index)] = 0;
  const int first = graph_.first_in(index);
  for (int l = first; l < first + graph_.degree(index); ++l) {
    const auto link = static_cast<std::size_t>(l);
    const LinkRates& rate = rates_[link];
    // The neighbour's bound travels beside the packet and is not attacked: seed 000 hands it round, section 5 of the
    // specification.
    received.neighbours += (1 - rate.dos) * at(graph_.links()[link].from).Pp;
    received.attack += rate.fdi * rate.delta * rate.delta;
    const Delivery& delivery = inbox[link];
    const bool lost = delivery.lost || (settings_.mode == Mode::drop && delivery.flagged);
    if (lost) ++lost_[static_cast<std::size_t>(index)];
    if (lost && !naive()) continue;
    ++received.delivered;
    if (naive()) {
      if (!lost) {
        held_[link] = delivery.payload;
      } else if (settings_.mode == Mode::naive_zero) {
        held_[link].setZero();
      }
    }
    for (int c = 0; c < states_; ++c) {
      const double value = naive() ? held_[link][c] : delivery.payload[c];
      received.pull[c] += wrap(value - node.xp[c], plant_->state()[static_cast<std::size_t>(c)].period);
    }
  }
  return received;
}

template <int N, int M>
void Filter<N, M>::observe(NodeState& node, int index, const Eigen::VectorXd& reading,
                           typename NodeState::MatMN& H) const {
  const Sensor& sensor = *sensors_[static_cast<std::size_t>(index)];
  node.measured = reading.allFinite();  // a row that is missing makes the whole reading missing: section 13
  if (!node.measured) return;
  sensor.measure(node.xp, node.innovation);
  for (int c = 0; c < sensor.size(); ++c) {
    node.innovation[c] = wrap(reading[c] - node.innovation[c], sensor.channels()[static_cast<std::size_t>(c)].period);
  }
  sensor.jacobian(node.xp, H);
}

template <int N, int M>
void Filter<N, M>::update(const Readings& readings, std::span<const Delivery> inbox, FaultReport& report) {
  for (int i = 0; i < static_cast<int>(nodes_.size()); ++i) {
    NodeState& node = nodes_[static_cast<std::size_t>(i)];
    typename NodeState::MatMN H(sensors_[static_cast<std::size_t>(i)]->size(), states_);
    observe(node, i, readings[static_cast<std::size_t>(i)], H);
    const Received<N> received = receive(i, inbox);
    if (!consensus::update(node, H, received, settings_.constants, graph_.degree(i))) {
      if (std::string* text = report.stop(i, "diverged")) {
        *text = fmt::format(
            "node {} diverged at step {}: its bound is not finite or the innovation's matrix cannot be inverted",
            ids_[static_cast<std::size_t>(i)], tick_);
      }
      return;
    }
  }
  widen_spectrum();
}

template <int N, int M>
void Filter<N, M>::widen_spectrum() {
  for (const NodeState& node : nodes_) {
    min_eigenvalue_ = std::min(min_eigenvalue_, node.phi_values[0]);
    max_eigenvalue_ = std::max(max_eigenvalue_, node.phi_values[node.phi_values.size() - 1]);
  }
}

template <int N, int M>
Belief Filter<N, M>::belief(int output) const {
  const NodeState& node = at(output);
  Belief belief{.mean = node.x.data(), .covariance = node.Phi.data()};
  if (node.measured) {
    belief.innovation = node.innovation.data();
    belief.innovation_covariance = node.innovation_bound.data();
    belief.innovation_size = static_cast<int>(node.innovation.size());
  }
  return belief;
}

template <int N, int M>
void Filter<N, M>::publish(std::span<double> values) const {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const NodeState& node = nodes_[i];
    const Slots& slots = slots_[i];
    values[static_cast<std::size_t>(slots.lambda_max)] = node.phi_values[node.phi_values.size() - 1];
    if (tick_ == 0) continue;
    values[static_cast<std::size_t>(slots.feasible28)] = node.feasible28 ? 1 : 0;
    values[static_cast<std::size_t>(slots.feasible29)] = node.feasible29 ? 1 : 0;
    values[static_cast<std::size_t>(slots.lost)] = lost_[i];
  }
}

template <int N, int M>
Json Filter<N, M>::design() const {
  const Constants& constants = settings_.constants;
  const int d_max = graph_.max_degree();
  bool valid = true;
  for (int i = 0; i < graph_.nodes(); ++i) valid = valid && bound_is_valid(constants.bound, graph_.degree(i));
  // Theorem 2: every eigenvalue of Phi(k|k) must lie in (low, high).
  return {{"eps", constants.eps},
          {"limit_28", constants.limit28()},
          {"limit_29", constants.limit29()},
          {"max_degree", d_max},
          {"bound_valid_for_degrees", valid},
          {"theorem2_low", d_max / ((1.0 + d_max) * constants.sigma)},
          {"theorem2_high", constants.limit28()}};
}

template <int N, int M>
std::vector<OwnMetric> Filter<N, M>::metrics() const {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const Constants& constants = settings_.constants;
  bool guaranteed = first_infeasible_ == 0;
  for (int i = 0; i < graph_.nodes(); ++i) guaranteed = guaranteed && bound_is_valid(constants.bound, graph_.degree(i));
  const int d_max = graph_.max_degree();
  const double low = d_max / ((1.0 + d_max) * constants.sigma);
  const bool holds = min_eigenvalue_ > low && max_eigenvalue_ < constants.limit28();
  const bool any = max_eigenvalue_ >= min_eigenvalue_;
  return {{-1, "first_infeasible_step", first_infeasible_ > 0 ? static_cast<double>(first_infeasible_) : none, false},
          {-1, "bound_guaranteed",
           naive()      ? none
           : guaranteed ? 1.0
                        : 0.0,
           true},
          {-1, "theorem2_holds", any ? (holds ? 1.0 : 0.0) : none, true},
          {-1, "theorem2_min_eig", any ? min_eigenvalue_ : none, false},
          {-1, "theorem2_max_eig", any ? max_eigenvalue_ : none, false}};
}

template <int N, int M>
void Filter<N, M>::retune(const Params& params) {
  apply_settings(read_settings(params, states_, graph_, published_));
}

template <int N, int M>
void Filter<N, M>::rewire(const Graph& graph, const std::vector<LinkRates>& rates) {
  Settings settings = read_settings(settings_.raw, states_, graph, rates);
  std::vector<typename NodeState::VecN> held;
  for (const Link& link : graph.links()) {
    const int old = graph_.find(link.from, link.to);
    held.push_back(old >= 0 ? held_[static_cast<std::size_t>(old)] : at(link.from).x);
  }
  graph_ = graph;
  published_ = rates;
  held_ = std::move(held);
  apply_settings(std::move(settings));
}

}  // namespace vigil::consensus
