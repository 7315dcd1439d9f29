#include "engine/run/lane.hpp"

#include <cmath>
#include <limits>

namespace vigil {
namespace {

/// Puts a method's own signals under the lane's name.
class LaneScope final : public SignalScope {
 public:
  LaneScope(std::string lane, const std::vector<std::string>& outputs, Catalogue& catalogue)
      : lane_(std::move(lane)), outputs_(outputs), catalogue_(catalogue) {}

  int add(int output, const std::string& name, const std::string& unit, SignalKind kind) override {
    return add(output, name, Signal{.unit = unit, .kind = kind});
  }

  int add_category(int output, const std::string& name, const std::vector<std::string>& words) override {
    Signal signal{.kind = SignalKind::category};
    for (const std::string& word : words) signal.labels.emplace_back(static_cast<int>(signal.labels.size()), word);
    return add(output, name, std::move(signal));
  }

 private:
  int add(int output, const std::string& name, Signal signal) {
    signal.lane = lane_;
    if (output >= 0) signal.node = outputs_[static_cast<std::size_t>(output)];
    signal.name = "lane." + lane_ + "." + (signal.node.empty() ? "" : signal.node + ".") + name;
    return catalogue_.add(std::move(signal));
  }

  std::string lane_;
  const std::vector<std::string>& outputs_;
  Catalogue& catalogue_;
};

std::string square_unit(const std::string& unit) { return unit.empty() ? "" : unit + "²"; }

}  // namespace

Lane::Lane(std::string id, std::string method_id, bool spared, std::unique_ptr<Method> method, Json params,
           const Plant& plant, const std::vector<int>& channels, const Graph& graph, const ScoreRules& rules)
    : id_(std::move(id)),
      method_id_(std::move(method_id)),
      spared_(spared),
      method_(std::move(method)),
      params_(std::move(params)),
      outputs_(method_->outputs()),
      score_(plant, outputs_, rules),
      attack_score_(channels, method_->window(), static_cast<int>(outputs_.size())) {
  for (const Component& component : plant.state()) periods_.push_back(component.period);
  inbox_.resize(method_->message() > 0 ? graph.links().size() : 0);
  for (Delivery& delivery : inbox_) delivery.payload = Eigen::VectorXd::Zero(method_->message());
  sent_ = Eigen::MatrixXd::Zero(method_->message(), graph.nodes());
  record_.lane = id_;
  record_.states = plant.states();
}

Lane::Lane(const Lane& other)
    : id_(other.id_),
      method_id_(other.method_id_),
      spared_(other.spared_),
      method_(other.method_->clone()),
      params_(other.params_),
      outputs_(other.outputs_),
      inbox_(other.inbox_),
      sent_(other.sent_),
      faults_(other.faults_),
      score_(other.score_),
      attack_score_(other.attack_score_),
      periods_(other.periods_),
      slots_(other.slots_),
      rmse_slot_(other.rmse_slot_),
      spread_slot_(other.spread_slot_),
      recording_(other.recording_),
      record_(other.record_) {
  record_.errors.reserve(other.record_.errors.capacity());
  record_.bounds.reserve(other.record_.bounds.capacity());
}

void Lane::record_bounds(std::int64_t ticks) {
  recording_ = method_->has_bound();
  if (!recording_) return;
  const std::size_t cells = static_cast<std::size_t>(ticks) * outputs_.size(), n = periods_.size();
  record_.errors.reserve(cells * n);
  record_.bounds.reserve(cells * n * n);
}

void Lane::declare(const Plant& plant, Catalogue& catalogue) {
  LaneScope scope(id_, outputs_, catalogue);
  const auto& groups = plant.errors();
  rmse_slot_ = scope.add(-1, "rmse", groups[0].unit, SignalKind::scalar);
  if (outputs_.size() > 1) spread_slot_ = scope.add(-1, "spread", groups[0].unit, SignalKind::scalar);
  for (int o = 0; o < static_cast<int>(outputs_.size()); ++o) {
    Slots slots{};
    slots.estimate = catalogue.size();
    for (const Component& component : plant.state())
      scope.add(o, "estimate." + component.name, component.unit, SignalKind::scalar);
    for (std::size_t g = 0; g < groups.size(); ++g) {
      const std::string suffix = g == 0 ? "" : "_" + groups[g].name;
      slots.error[g] = scope.add(o, "error" + suffix, groups[g].unit, SignalKind::scalar);
      slots.bound[g] = scope.add(o, "bound" + suffix, square_unit(groups[g].unit), SignalKind::scalar);
    }
    slots.nees = scope.add(o, "nees", "", SignalKind::scalar);
    slots.nis = scope.add(o, "nis", "", SignalKind::scalar);
    slots_.push_back(slots);
  }
  method_->declare(scope);
}

void Lane::exchange(const Graph& graph, std::span<const int> base, const LinkEffects& effects) {
  for (int node = 0; node < graph.nodes(); ++node) method_->send(node, sent_.col(node));
  for (std::size_t l = 0; l < graph.links().size(); ++l) {
    Delivery& delivery = inbox_[l];
    const int place = base[l];
    const LinkState state = spared_ ? LinkState::clean : effects.state[static_cast<std::size_t>(place)];
    delivery.lost = state == LinkState::dos;
    delivery.flagged = state == LinkState::fdi;
    delivery.payload = sent_.col(graph.links()[l].from);
    if (delivery.flagged) delivery.payload += effects.injected.col(place);  // (6)
  }
}

void Lane::tick(std::int64_t k, const Graph& graph, std::span<const int> base, const LinkEffects& effects,
                const Eigen::VectorXd& input, const Readings& readings) {
  if (stopped()) return;
  faults_.begin_tick(k);
  method_->predict(input, faults_);
  if (stopped()) return;
  method_->measure(readings, faults_);
  if (stopped()) return;
  if (method_->message() > 0) exchange(graph, base, effects);
  method_->update(readings, inbox_, faults_);
}

void Lane::publish(std::int64_t k, const Eigen::VectorXd& truth, const SensorEffects& attacks, const Plant& plant,
                   std::span<double> values) {
  if (stopped()) return;
  if (k > 0 && method_->window() > 0) {
    attack_score_.note(attacks);
    for (int o = 0; o < static_cast<int>(outputs_.size()); ++o)
      attack_score_.judge(o, method_->reconstruction(o), method_->choice(o));
  }
  double square = 0;
  for (int o = 0; o < static_cast<int>(outputs_.size()); ++o) publish_output(k, o, truth, plant, values, square);
  values[static_cast<std::size_t>(rmse_slot_)] = std::sqrt(square / static_cast<double>(outputs_.size()));
  if (spread_slot_ >= 0) publish_spread(plant, values);
  method_->publish(values);
}

void Lane::publish_output(std::int64_t k, int output, const Eigen::VectorXd& truth, const Plant& plant,
                          std::span<double> values, double& square) {
  const Belief belief = method_->belief(output);
  const Slots& slots = slots_[static_cast<std::size_t>(output)];
  const auto put = [&](int slot, double value) { values[static_cast<std::size_t>(slot)] = value; };
  const int n = plant.states();
  for (int c = 0; c < n; ++c) put(slots.estimate + c, belief.mean[c]);
  const TickScore score = score_.judge(k, output, truth, belief);
  const auto& groups = plant.errors();
  for (std::size_t g = 0; g < groups.size(); ++g) {
    put(slots.error[g], score.error[g]);
    if (belief.covariance == nullptr) continue;
    double trace = 0;
    for (const int c : groups[g].components) trace += belief.covariance[c * n + c];
    put(slots.bound[g], trace);
  }
  put(slots.nees, score.nees);
  put(slots.nis, score.nis);
  square += score.error[0] * score.error[0];
  if (recording_ && k > 0 && belief.covariance != nullptr) {
    const BoundedVector e = state_error(truth, belief.mean, periods_);
    record_.errors.insert(record_.errors.end(), e.data(), e.data() + n);
    record_.bounds.insert(record_.bounds.end(), belief.covariance, belief.covariance + n * n);
  }
}

/// Consensus spread: the largest distance of an estimate from the nodes' mean, over the position-like components.
void Lane::publish_spread(const Plant& plant, std::span<double> values) const {
  const auto& components = plant.errors()[0].components;
  const auto count = static_cast<double>(outputs_.size());
  double worst = 0;
  for (const Slots& node : slots_) {
    double square = 0;
    for (const int c : components) {
      double mean = 0;
      for (const Slots& other : slots_) mean += values[static_cast<std::size_t>(other.estimate + c)] / count;
      const double off = values[static_cast<std::size_t>(node.estimate + c)] - mean;
      square += off * off;
    }
    worst = std::max(worst, square);
  }
  values[static_cast<std::size_t>(spread_slot_)] = std::sqrt(worst);
}

void Lane::rewire(const Graph& graph, const std::vector<LinkRates>& rates) {
  method_->rewire(graph, spared_ ? std::vector<LinkRates>(rates.size()) : rates);
  if (method_->message() == 0) return;
  inbox_.resize(graph.links().size());
  for (Delivery& delivery : inbox_) delivery.payload = Eigen::VectorXd::Zero(method_->message());
}

}  // namespace vigil
