#include "engine/run/contender.hpp"

#include <fmt/format.h>

#include <cmath>

namespace vigil {

Contender::Contender(std::unique_ptr<Method> method, std::unique_ptr<privacy::Protection> protection,
                     const World& world, const Graph& graph, Side side, bool monitor, std::optional<std::int64_t> last)
    : method_(std::move(method)),
      protection_(std::move(protection)),
      side_(side),
      monitor_(monitor),
      reach_(std::min(last.value_or(SensorChannels::kMemory), SensorChannels::kMemory) + 1) {
  if (side_ != Side::shared) course_ = Course(world);
  if (side_ == Side::marked || side_ == Side::closed) channels_ = SensorChannels(world.sensors, last);
  if (method_->continuous() != nullptr) flow_ = LaneFlow(world, *method_->continuous());
  make_inbox(graph);
}

Contender::Contender(const Contender& other)
    : method_(other.method_->clone()),
      protection_(other.protection_ ? other.protection_->clone() : nullptr),
      side_(other.side_),
      monitor_(other.monitor_),
      reach_(other.reach_),
      course_(other.course_),
      flow_(other.flow_),
      channels_(other.channels_),
      inbox_(other.inbox_),
      outbox_(other.outbox_),
      memory_(other.memory_),
      detections_(other.detections_),
      has_judged_(other.has_judged_) {
  for (const auto& detector : other.detectors_) detectors_.push_back(detector->clone());
}

void Contender::attach(const Detector& detector) {
  detectors_.clear();
  for (std::size_t o = 0; o < method_->outputs().size(); ++o) detectors_.push_back(detector.clone());
  detections_.assign(detectors_.size(), {});
}

void Contender::retune_detector(const Params& params) {
  for (const auto& detector : detectors_) detector->retune(params);
}

void Contender::make_inbox(const Graph& graph) {
  inbox_.resize(method_->message() > 0 ? graph.links().size() : 0);
  for (Delivery& delivery : inbox_) delivery.payload = Eigen::VectorXd::Zero(method_->message());
  outbox_ = Eigen::MatrixXd::Zero(method_->message(), graph.nodes());
  if (method_->message() > 0) memory_ = MessageMemory(outbox_.rows(), outbox_.cols(), graph.links().size(), reach_);
}

void Contender::begin(const Tick& tick, bool attacked, FaultTable& faults) {
  const World& world = tick.world;
  const Course& shared = tick.shared;
  if (side_ != Side::shared) {
    course_.truth = shared.truth;
    if (world.continuous() != nullptr && side_ != Side::recorded) course_.begin_flow(world);
    if (side_ == Side::closed && world.controller) act(0, world);
  }
  const Course& seen = course(shared);
  if (ContinuousMethod* method = method_->continuous()) flow_.begin(seen.received, seen.input, *method);
  if (method_->fusion() == nullptr) return;
  exchange(tick, attacked);
  method_->update(seen.received, inbox_, faults);
}

void Contender::tick(const Tick& tick, bool attacked, const SensorEffects& none, FaultTable& faults) {
  sense(tick, attacked, attacked ? tick.sensors : none);
  const Course& seen = course(tick.shared);
  const Readings& arrived = attacked ? seen.received : seen.sent;
  const Readings& heard = monitor_ ? seen.sent : arrived;
  if (method_->continuous() != nullptr) {
    flow(tick, attacked, seen, heard, faults);
  } else {
    method_->predict(seen.input, faults);
  }
  if (faults.stopped()) return;
  method_->measure(heard, faults);
  if (faults.stopped()) return;
  if (method_->message() > 0) exchange(tick, attacked);
  method_->update(heard, inbox_, faults);
  if (faults.stopped()) return;
  method_->judge(arrived, faults);
  if (attached()) detect(tick.k);
  if (side_ == Side::closed && tick.world.controller) act(tick.k, tick.world);
}

void Contender::flow(const Tick& tick, bool attacked, const Course& seen, const Readings& heard, FaultReport& faults) {
  ContinuousMethod& method = *method_->continuous();
  const bool finite = tick.traced || side_ == Side::recorded
                          ? flow_.follow_trace(tick.k, heard, seen.input, method)
                          : flow_.follow(tick.world, tick.k, attacked, seen, heard, method);
  if (finite) return;
  if (std::string* detail = faults.stop(-1, "diverged")) {
    *detail = fmt::format(
        "the observers' state is no longer finite; steps of {:.3g} s serve poles up to {:.3g} 1/s: a smaller time.dt "
        "makes them smaller",
        flow_.step(), method.fastest());
  }
}

/// Steps 1 to 3: the plant, its sensors, what leaves them, what arrives.
void Contender::sense(const Tick& tick, bool attacked, const SensorEffects& effects) {
  if (side_ == Side::shared || side_ == Side::recorded) return;
  if (side_ == Side::closed) {
    course_.advance(tick.world, tick.k, attacked);
    course_.sense(tick.world);
  } else {
    course_.truth = tick.shared.truth;
    course_.input = tick.shared.input;
    course_.past = tick.shared.past;
    course_.drives = tick.shared.drives;
    course_.readings = tick.shared.readings;
  }
  for (int i = 0; i < static_cast<int>(course_.readings.size()); ++i) {
    const auto node = static_cast<std::size_t>(i);
    method_->emit(i, course_.readings[node], course_.input, course_.sent[node]);
  }
  channels_.carry(tick.k, tick.world, effects, course_);
}

void Contender::exchange(const Tick& tick, bool attacked) {
  const Graph& graph = tick.graph;
  for (int node = 0; node < graph.nodes(); ++node) method_->send(node, outbox_.col(node));
  if (protection_) protection_->encode({.k = tick.k, .steps = {}, .gains = {}, .P = {}, .nominal = {}}, outbox_);
  for (std::size_t l = 0; l < graph.links().size(); ++l) {
    Delivery& delivery = inbox_[l];
    const int place = tick.base[l];
    const LinkState state = attacked ? tick.links.state[static_cast<std::size_t>(place)] : LinkState::clean;
    delivery.lost = state == LinkState::dos;
    delivery.flagged = state == LinkState::fdi || state == LinkState::replay;
    const int from = graph.links()[l].from;
    delivery.payload = outbox_.col(from);
    if (state == LinkState::replay) {
      const double* played = memory_.play(tick.k, l, from, tick.links.playback[static_cast<std::size_t>(place)]);
      if (played != nullptr) delivery.payload = Eigen::Map<const Eigen::VectorXd>(played, outbox_.rows());
    }
    if (delivery.flagged) delivery.payload += tick.links.injected.col(place);  // seed 000, (6)
  }
  memory_.note(tick.k, outbox_);
}

/// Step 5 of attached detectors. A method in continuous time says the norm of its innovation alone.
void Contender::detect(std::int64_t k) {
  static const Eigen::MatrixXd kNone;
  for (std::size_t o = 0; o < detectors_.size(); ++o) {
    const int output = static_cast<int>(o);
    const Belief belief = method_->belief(output);
    const int size = belief.innovation == nullptr ? 0 : belief.innovation_size;
    const double norm = method_->continuous() == nullptr ? std::nan("") : method_->unknown_inputs(output).innovation;
    if (size > 0) {
      const Eigen::Map<const Eigen::VectorXd> innovation(belief.innovation, size);
      const bool known = belief.innovation_covariance != nullptr;
      detections_[o] =
          known ? detectors_[o]->judge(k, innovation,
                                       Eigen::Map<const Eigen::MatrixXd>(belief.innovation_covariance, size, size))
                : detectors_[o]->judge(k, innovation, kNone);
    } else if (std::isfinite(norm)) {
      detections_[o] = detectors_[o]->judge(k, Eigen::Matrix<double, 1, 1>(norm), kNone);
    } else {
      detections_[o] = detectors_[o]->hold();
    }
    has_judged_ = has_judged_ || detections_[o].judged;
  }
}

/// Step 6: the lane's own estimate drives its plant.
void Contender::act(std::int64_t k, const World& world) {
  const double* estimate = method_->ready() ? method_->belief(0).mean : nullptr;
  world.controller->input(k, estimate, course_.upcoming);
  method_->mark_input(k, course_.upcoming);
}

void Contender::rewire(const Graph& graph, const std::vector<LinkRates>& rates) {
  method_->rewire(graph, rates);
  if (method_->message() > 0) make_inbox(graph);
}

}  // namespace vigil
