#include "engine/methods/sparse/filter.hpp"

#include <fmt/format.h>

#include <cmath>

#include "engine/core/missing.hpp"
#include "engine/methods/sparse/identifiability.hpp"

namespace vigil::sparse {
namespace {

WindowShape read_shape(const Params& params, const Knowledge& knowledge) {
  if (!knowledge.plant->linear() || knowledge.plant->inputs() > 0)
    throw InputError("/T", "a window looks back through the plant, which must be linear and without inputs");
  WindowShape shape{knowledge.sensors.front()->size(), params.integer("T"), knowledge.plant->states(),
                    params.integer("q")};
  for (const auto& sensor : knowledge.sensors) {
    if (sensor->size() != shape.channels)
      throw InputError("/q", "the supports of nodes are compared, so every sensor must have the same channels");
  }
  if (shape.q > shape.channels)
    throw InputError("/q", fmt::format("q is {}; a sensor has {} channels", shape.q, shape.channels),
                     fmt::format("0 to {}", shape.channels));
  return shape;
}

Eigen::MatrixXd transition_of(const Plant& plant) {
  const Eigen::VectorXd origin = Eigen::VectorXd::Zero(plant.states()), none;
  Eigen::MatrixXd F(plant.states(), plant.states());
  plant.jacobian(origin, none, F);
  return F;
}

Linearisation read_linearisation(const std::string& text) {
  if (text == "current") return Linearisation::current;
  return text == "frozen" ? Linearisation::frozen : Linearisation::prior;
}

}  // namespace

SparseFilter::SparseFilter(const Params& params, const Knowledge& knowledge, MakeReconstructor make, bool game)
    : plant_(knowledge.plant),
      ids_(knowledge.nodes),
      Q_(knowledge.Q),
      shape_(read_shape(params, knowledge)),
      update_at_once_(params.text("startup") == "update"),
      as_printed_(params.boolean("printed_azimuth_row")),
      make_(make),
      transition_(transition_of(*plant_), shape_.window),
      regression_(shape_.channels, shape_.window, shape_.states),
      reconstructor_(make == nullptr ? nullptr : make(params, shape_)),
      graph_(knowledge.graph),
      E_(Eigen::MatrixXd::Zero(shape_.size(), static_cast<Eigen::Index>(ids_.size()))),
      ready_(ids_.size(), 0),
      heard_(graph_.links().size(), 0),
      identifiability_(identifiability(knowledge, shape_.window, shape_.q, params.real("report_time"))) {
  if (game) game_.emplace(params, Draws(knowledge.seed, "method.game"), graph_);
  const Linearisation where = read_linearisation(params.text("window"));
  for (std::size_t i = 0; i < ids_.size(); ++i) {
    const auto& sensor = knowledge.sensors[i];
    const Gaussian start{knowledge.estimates.col(static_cast<Eigen::Index>(i)), knowledge.P0};
    nodes_.push_back(
        {sensor, Window(sensor, shape_.window, where, as_printed_), start, {}, {}, kMissing, kMissing, false});
    own_.push_back(start);
  }
}

SparseFilter::SparseFilter(const SparseFilter& other)
    : plant_(other.plant_),
      ids_(other.ids_),
      Q_(other.Q_),
      shape_(other.shape_),
      update_at_once_(other.update_at_once_),
      as_printed_(other.as_printed_),
      make_(other.make_),
      transition_(other.transition_),
      regression_(other.regression_),
      reconstructor_(other.reconstructor_ ? other.reconstructor_->clone() : nullptr),
      game_(other.game_),
      graph_(other.graph_),
      nodes_(other.nodes_),
      own_(other.own_),
      E_(other.E_),
      ready_(other.ready_),
      heard_(other.heard_),
      slots_(other.slots_),
      tick_(other.tick_),
      identifiability_(other.identifiability_) {}

void SparseFilter::declare(SignalScope& scope) {
  slots_.assign(ids_.size(), {});
  if (!reconstructor_) return;
  for (int i = 0; i < static_cast<int>(ids_.size()); ++i) {
    Slots& slots = slots_[static_cast<std::size_t>(i)];
    for (const Component& channel : nodes_[static_cast<std::size_t>(i)].sensor->channels()) {
      const int id = scope.add(i, "attack." + channel.name, channel.unit, SignalKind::scalar);
      if (slots.attack < 0) slots.attack = id;
    }
    slots.statistic = scope.add(i, "statistic", "", SignalKind::scalar);
    if (!std::isnan(reconstructor_->threshold(1))) slots.threshold = scope.add(i, "threshold", "", SignalKind::scalar);
    slots.alarm = scope.add(i, "alarm", "", SignalKind::boolean);
    if (!game_) continue;
    slots.choice = scope.add_category(i, "choice", ids_);
    for (int j = 0; j < static_cast<int>(ids_.size()); ++j) {
      if (j != i && graph_.find(j, i) < 0) continue;
      const std::string& id = ids_[static_cast<std::size_t>(j)];
      slots.utility.emplace_back(j, scope.add(i, "utility." + id, "", SignalKind::scalar));
      slots.probability.emplace_back(j, scope.add(i, "probability." + id, "", SignalKind::scalar));
    }
  }
}

void SparseFilter::predict(const Eigen::VectorXd& input, FaultReport& /*report*/) {
  ++tick_;
  for (Node& node : nodes_) kalman_predict(node.state, *plant_, input, Q_);
}

void SparseFilter::measure(const Readings& readings, FaultReport& report) {
  for (std::size_t i = 0; i < nodes_.size(); ++i) measure_node(i, readings[i], report);
}

void SparseFilter::measure_node(std::size_t i, const Eigen::VectorXd& reading, FaultReport& report) {
  Node& node = nodes_[i];
  node.searched = false;
  node.innovation = {};
  node.statistic = node.threshold = kMissing;
  ready_[i] = 0;
  E_.col(static_cast<Eigen::Index>(i)).setZero();
  if (!reading.allFinite()) {  // predict only; the window must fill again
    node.window.clear();
    return;
  }
  node.window.push(reading, node.state.mean);
  if (node.sensor->limited(node.state.mean)) {
    if (std::string* text = report.fault(static_cast<int>(i), "singular_geometry"))
      *text = "node " + ids_[i] + ": the estimate stands where a bearing has no direction; its derivative was limited";
  }
  if (node.window.full()) {
    if (reconstructor_) ready_[i] = search(i, report) ? 1 : 0;
  } else if (!update_at_once_) {
    return;
  }
  update_node(i, report);
}

/// Seeks the attack in a full window. False where nothing could be said: E is zero then.
bool SparseFilter::search(std::size_t i, FaultReport& report) {
  Node& node = nodes_[i];
  node.window.regress(node.state.mean, transition_, regression_);
  if (!regression_.observable) {
    if (std::string* text = report.fault(static_cast<int>(i), "unobservable"))
      *text = "node " + ids_[i] + ": the window does not determine the state, so no attack is sought";
    return false;
  }
  node.searched = true;
  node.statistic = regression_.statistic;
  node.threshold = reconstructor_->threshold(regression_.sigma);
  if (reconstructor_->solve(regression_, E_.col(static_cast<Eigen::Index>(i)))) return true;
  if (std::string* text = report.fault(static_cast<int>(i), "unsolved"))
    *text = "node " + ids_[i] + ": the solver found no attack that explains the window; none is taken off";
  return true;
}

void SparseFilter::update_node(std::size_t i, FaultReport& report) {
  Node& node = nodes_[i];
  const Eigen::Index p = shape_.channels;
  node.innovation.r.resize(p);
  node.innovation.H.resize(p, shape_.states);
  node.innovation.R = node.sensor->noise();
  node.window.newest(node.state.mean, node.innovation.r, node.innovation.H);
  node.innovation.r -= E_.col(static_cast<Eigen::Index>(i)).tail(p);
  node.innovation_covariance = innovation_covariance(node.innovation, node.state.covariance);
  Gaussian next = node.state;
  if (kalman_update(next, node.innovation)) {
    node.state = next;
    return;
  }
  node.innovation = {};
  if (std::string* text = report.fault(static_cast<int>(i), "update_failed"))
    *text = "node " + ids_[i] + ": the innovation's covariance is not positive definite; the reading was not used";
}

void SparseFilter::send(int node, Eigen::Ref<Eigen::VectorXd> message) const {
  message = nodes_[static_cast<std::size_t>(node)].state.mean;
}

void SparseFilter::update(const Readings& /*readings*/, std::span<const Delivery> inbox, FaultReport& report) {
  if (game_) play(inbox);
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Gaussian& state = nodes_[i].state;
    if (state.mean.allFinite() && state.covariance.allFinite()) continue;
    if (std::string* text = report.stop(static_cast<int>(i), "diverged"))
      *text = "node " + ids_[i] + ": the filter is no longer finite";
    return;
  }
}

void SparseFilter::play(std::span<const Delivery> inbox) {
  for (std::size_t l = 0; l < inbox.size(); ++l) heard_[l] = inbox[l].lost ? 0 : 1;
  game_->play(tick_, E_, ready_, heard_);
  for (std::size_t i = 0; i < nodes_.size(); ++i) own_[i] = nodes_[i].state;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const int j = game_->choice(static_cast<int>(i));
    if (j < 0 || j == static_cast<int>(i)) continue;
    // The estimate comes over the link, where it can be falsified; its covariance is declared beside it.
    const Eigen::VectorXd& heard = inbox[static_cast<std::size_t>(graph_.find(j, static_cast<int>(i)))].payload;
    if (!heard.allFinite()) continue;
    nodes_[i].state.mean = heard;
    nodes_[i].state.covariance = own_[static_cast<std::size_t>(j)].covariance;
  }
}

Belief SparseFilter::belief(int output) const {
  const Node& node = nodes_[static_cast<std::size_t>(output)];
  Belief belief{.mean = node.state.mean.data(), .covariance = node.state.covariance.data()};
  if (!node.innovation.empty()) {
    belief.innovation = node.innovation.r.data();
    belief.innovation_covariance = node.innovation_covariance.data();
    belief.innovation_size = shape_.channels;
  }
  return belief;
}

Reconstruction SparseFilter::reconstruction(int output) const {
  const auto i = static_cast<std::size_t>(output);
  if (!reconstructor_ || !reconstructor_->selects() || !nodes_[i].searched) return {};
  return {E_.col(output).data(), shape_.channels, shape_.window};
}

void SparseFilter::publish(std::span<double> values) const {
  if (!reconstructor_) return;
  const auto put = [&](int slot, double value) {
    if (slot >= 0) values[static_cast<std::size_t>(slot)] = value;
  };
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    const auto E = E_.col(static_cast<Eigen::Index>(i));
    if (!node.searched) continue;
    for (int c = 0; c < shape_.channels; ++c) put(slots_[i].attack + c, E[E.size() - shape_.channels + c]);
    put(slots_[i].statistic, node.statistic);
    put(slots_[i].threshold, node.threshold);
    put(slots_[i].alarm, (E.array() != 0).any() ? 1 : 0);
    if (game_) publish_game(static_cast<int>(i), values);
  }
}

void SparseFilter::publish_game(int output, std::span<double> values) const {
  const Slots& slots = slots_[static_cast<std::size_t>(output)];
  if (game_->choice(output) < 0) return;
  values[static_cast<std::size_t>(slots.choice)] = game_->choice(output);
  for (const auto& [j, slot] : slots.utility) values[static_cast<std::size_t>(slot)] = game_->utility(output, j);
  for (const auto& [j, slot] : slots.probability)
    values[static_cast<std::size_t>(slot)] = game_->probability(output, j);
}

Json SparseFilter::design() const { return {{"identifiability", identifiability_}}; }

void SparseFilter::retune(const Params& params) {
  if (make_ != nullptr) reconstructor_ = make_(params, shape_);
  if (game_) game_->retune(params);
}

void SparseFilter::rewire(const Graph& graph, const std::vector<LinkRates>& /*rates*/) {
  graph_ = graph;
  heard_.assign(graph_.links().size(), 0);
  if (game_) game_->rewire(graph);
}

}  // namespace vigil::sparse
