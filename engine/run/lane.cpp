#include "engine/run/lane.hpp"

#include <algorithm>

#include "engine/run/lane_scope.hpp"
#include "engine/run/sensor_signals.hpp"
#include "engine/run/setup.hpp"

namespace vigil {
namespace {

/// The states that each output estimates: all, where the method does not say.
std::vector<std::vector<int>> components_of(const Method& method, const Plant& plant) {
  std::vector<std::vector<int>> all;
  for (int o = 0; o < static_cast<int>(method.outputs().size()); ++o) {
    all.push_back(method.components(o));
    if (!all.back().empty()) continue;
    for (int c = 0; c < plant.states(); ++c) all.back().push_back(c);
  }
  return all;
}

std::string square_unit(const std::string& unit) { return unit.empty() ? "" : unit + "²"; }

}  // namespace

Lane::Lane(LaneOptions options, std::unique_ptr<Method> method, std::unique_ptr<privacy::Protection> protection,
           const Detector* detector, const World& world, const Graph& graph)
    : options_(std::move(options)),
      contender_(std::move(method), std::move(protection), world, graph, options_.side, options_.monitor,
                 options_.last),
      outputs_(contender_.method().outputs()),
      components_(components_of(contender_.method(), *world.plant)),
      score_(*world.plant, outputs_, options_.rules, components_),
      state_score_(*world.plant, options_.rules.state_from),
      twin_score_(state_score_),
      alarms_(outputs_.size(), 0),
      marked_(outputs_.size(), 0) {
  const Method& mine = contender_.method();
  std::vector<int> channels;
  for (const auto& sensor : world.sensors) channels.push_back(sensor->size());
  no_effects_.resize(channels);
  recorded_effects_.resize(channels);
  attack_score_ = AttackScore(channels, mine.window(), static_cast<int>(outputs_.size()));
  for (const Component& component : world.plant->state()) periods_.push_back(component.period);
  if (detector != nullptr) contender_.attach(*detector);
  if (contender_.detects()) detection_.assign(outputs_.size(), {options_.rules.detection_from, contender_.tail()});
  if (mine.continuous() != nullptr && world.continuous() != nullptr) {
    ports_ = world.continuous()->ports();
    input_score_ = InputScore(components_, ports_, options_.rules.window);
  }
  if (const FusionMethod* fusion = mine.fusion()) {
    fusion_side_.emplace(*fusion, options_.id, outputs_, *world.plant, options_.last);
    overheard_.assign(static_cast<std::size_t>(graph.nodes()), 0);
  }
  const bool simulated = options_.side == Contender::Side::closed || options_.side == Contender::Side::marked;
  if (!options_.spared && simulated) twin_.emplace(contender_);
  record_.lane = options_.id;
  record_.states = world.plant->states();
}

Lane::Lane(const Lane& other)
    : options_(other.options_),
      contender_(other.contender_),
      twin_(other.twin_),
      outputs_(other.outputs_),
      faults_(other.faults_),
      twin_faults_(other.twin_faults_),
      no_effects_(other.no_effects_),
      recorded_effects_(other.recorded_effects_),
      components_(other.components_),
      score_(other.score_),
      attack_score_(other.attack_score_),
      state_score_(other.state_score_),
      twin_score_(other.twin_score_),
      detection_(other.detection_),
      roc_(other.roc_),
      input_score_(other.input_score_),
      fusion_side_(other.fusion_side_),
      overheard_(other.overheard_),
      periods_(other.periods_),
      ports_(other.ports_),
      slots_(other.slots_),
      course_slot_(other.course_slot_),
      sensor_slot_(other.sensor_slot_),
      rmse_slot_(other.rmse_slot_),
      spread_slot_(other.spread_slot_),
      alarms_(other.alarms_),
      marked_(other.marked_),
      recording_(other.recording_),
      record_(other.record_) {
  record_.errors.reserve(other.record_.errors.capacity());
  record_.bounds.reserve(other.record_.bounds.capacity());
}

void Lane::record_bounds(std::int64_t ticks) {
  recording_ = method().has_bound();
  if (!recording_) return;
  const std::size_t cells = static_cast<std::size_t>(ticks) * outputs_.size(), n = periods_.size();
  record_.errors.reserve(cells * n);
  record_.bounds.reserve(cells * n * n);
}

void Lane::declare(const World& world, const std::vector<std::string>& nodes, Catalogue& catalogue) {
  LaneScope scope(id(), outputs_, catalogue);
  const auto& groups = world.plant->errors();
  rmse_slot_ = scope.add(-1, "rmse", groups[0].unit, SignalKind::scalar);
  const bool flows = !ports_.empty();
  if (outputs_.size() > 1 && !flows) spread_slot_ = scope.add(-1, "spread", groups[0].unit, SignalKind::scalar);
  if (options_.side != Contender::Side::shared) declare_course(world, nodes, scope, catalogue);
  for (int o = 0; o < static_cast<int>(outputs_.size()); ++o) {
    Slots slots{};
    slots.estimate = catalogue.size();
    for (const int c : components_[static_cast<std::size_t>(o)]) {
      const Component& component = world.plant->state()[static_cast<std::size_t>(c)];
      scope.add(o, "estimate." + component.name, component.unit, SignalKind::scalar);
    }
    for (std::size_t g = 0; g < groups.size(); ++g) {
      const std::string suffix = g == 0 ? "" : "_" + groups[g].name;
      slots.error[g] = scope.add(o, "error" + suffix, groups[g].unit, SignalKind::scalar);
      if (flows) continue;
      slots.bound[g] = scope.add(o, "bound" + suffix, square_unit(groups[g].unit), SignalKind::scalar);
    }
    if (flows) {
      declare_unknown(o, scope, slots);
    } else {
      slots.nees = scope.add(o, "nees", "", SignalKind::scalar);
      slots.nis = scope.add(o, "nis", "", SignalKind::scalar);
    }
    if (contender_.detects()) {
      slots.statistic = scope.add(o, "statistic", "", SignalKind::scalar);
      slots.threshold = scope.add(o, "threshold", "", SignalKind::scalar);
      slots.alarm = scope.add(o, "alarm", "", SignalKind::boolean);
    }
    slots_.push_back(slots);
  }
  if (fusion_side_) fusion_side_->declare(*world.plant, catalogue);
  method().declare(scope);
}

void Lane::declare_unknown(int output, SignalScope& scope, Slots& slots) const {
  const DrivePorts& ports = ports_[static_cast<std::size_t>(output)];
  const auto add = [&](const std::string& name) { return scope.add(output, name, "", SignalKind::scalar); };
  std::vector<int> ids;
  for (int c = 1; c <= ports.w; ++c) ids.push_back(add("attack.w" + std::to_string(c)));
  for (int c = 1; c <= ports.f; ++c) ids.push_back(add("fault.f" + std::to_string(c)));
  ids.push_back(add("innovation"));
  slots.unknown = ids.front();
}

/// lane.<lane>.truth.…, .input.…, .sensor.…: what belongs to the lane.
void Lane::declare_course(const World& world, const std::vector<std::string>& nodes, SignalScope& scope,
                          Catalogue& catalogue) {
  course_slot_ = catalogue.size();
  for (const Component& c : world.plant->state()) scope.add(-1, "truth." + c.name, c.unit, SignalKind::scalar);
  for (const Component& c : world.plant->input()) scope.add(-1, "input." + c.name, c.unit, SignalKind::scalar);
  if (ports_.empty()) {
    for (const std::string& name : drive_names(world, nodes)) scope.add(-1, name, "", SignalKind::scalar);
  }
  sensor_slot_ = declare_sensors("lane." + id() + ".", id(), nodes, world, catalogue);
}

void Lane::begin(const Tick& tick) {
  faults_.begin_tick(tick.k);
  contender_.begin(tick, !options_.spared, faults_);
  twin_faults_.begin_tick(tick.k);
  if (twin_) twin_->begin(tick, false, twin_faults_);
  listen(tick);
}

/// Those who overhear the lane's messages to its fusion centre. A lane that is spared is not overheard.
void Lane::listen(const Tick& tick) {
  if (!fusion_side_ || stopped()) return;
  for (std::size_t l = 0; l < overheard_.size(); ++l) {
    const auto place = static_cast<std::size_t>(tick.base[l]);
    overheard_[l] = options_.spared ? 0 : tick.links.overheard[place];
  }
  fusion_side_->listen(*method().fusion(), contender_.sent_messages(), overheard_);
}

const SensorEffects& Lane::effects(const Tick& tick) const {
  if (options_.side == Contender::Side::recorded) return recorded_effects_;
  return options_.spared ? no_effects_ : tick.sensors;
}

void Lane::tick(const Tick& tick) {
  if (stopped()) return;
  faults_.begin_tick(tick.k);
  contender_.tick(tick, !options_.spared, no_effects_, faults_);
  if (twin_ && !twin_faults_.stopped()) {
    twin_faults_.begin_tick(tick.k);
    twin_->tick(tick, false, no_effects_, twin_faults_);
  }
  if (stopped()) return;
  listen(tick);
  judge(tick);
}

/// Step 7, apart from the errors that are signals, too.
void Lane::judge(const Tick& tick) {
  if (method().window() > 0) {
    attack_score_.note(contender_.course(tick.shared).injected, effects(tick).state);
    for (int o = 0; o < static_cast<int>(outputs_.size()); ++o)
      attack_score_.judge(o, method().reconstruction(o), method().choice(o));
  }
  if (contender_.detects()) judge_detection(tick);
  if (!ports_.empty()) {
    const Course& seen = contender_.course(tick.shared);
    for (int o = 0; o < static_cast<int>(outputs_.size()); ++o)
      input_score_.note(tick.k, o, seen.truth, seen.drives, method().belief(o).mean, method().unknown_inputs(o));
    return;  // the rest scores one estimate of the whole state
  }
  if (options_.side == Contender::Side::shared) return;
  if (method().ready()) state_score_.note(tick.k, contender_.course(tick.shared).truth, method().belief(0).mean);
  if (twin_ && twin_->method().ready())
    twin_score_.note(tick.k, twin_->course(tick.shared).truth, twin_->method().belief(0).mean);
}

void Lane::judge_detection(const Tick& tick) {
  for (std::size_t o = 0; o < outputs_.size(); ++o) {
    const int output = static_cast<int>(o);
    const Detection detection = contender_.detection(output);
    alarms_[o] = detection.alarm ? 1 : 0;
    const bool twin_alarm = twin_ && !twin_faults_.stopped() && twin_->detection(output).alarm;
    const auto counted = detection_[o].note(tick.k, attacked(tick, output), detection.alarm, twin_alarm);
    if (roc_.empty() || counted == DetectionScore::Counted::neither) continue;
    const bool hit = counted == DetectionScore::Counted::attacked;
    roc_[o].note(hit, detection.statistic, detection.threshold, detection.alarm);
  }
}

/// Something was done to what this output hears in this tick: to its sensor, to a link into it, to an actuator of its
/// plant; an output that is no node hears them all.
bool Lane::attacked(const Tick& tick, int output) const {
  const SensorEffects& sensors = effects(tick);
  const auto place = static_cast<std::size_t>(output);
  const bool node = outputs_.size() >= sensors.state.size() && place < sensors.state.size();
  const auto hit = [](SensorState state) { return state != SensorState::clean; };
  if (node ? hit(sensors.state[place]) : std::any_of(sensors.state.begin(), sensors.state.end(), hit)) return true;
  if (options_.spared) return false;
  const bool pushed =
      ports_.empty() ? (contender_.course(tick.shared).drives.array().abs() > 0).any() : !tick.world.actuators.idle();
  if (pushed) return true;
  if (method().message() == 0) return false;
  for (std::size_t l = 0; l < tick.graph.links().size(); ++l) {
    const bool here = !node || tick.graph.links()[l].to == output;
    if (here && tick.links.state[static_cast<std::size_t>(tick.base[l])] != LinkState::clean) return true;
  }
  return false;
}

void Lane::mark_edges(std::int64_t k, Sink& sink) {
  for (std::size_t o = 0; o < alarms_.size(); ++o) {
    if (alarms_[o] == marked_[o]) continue;
    marked_[o] = alarms_[o];
    Mark mark;
    mark.k = k;
    mark.type = MarkType::alarm;
    mark.edge = alarms_[o] != 0 ? MarkEdge::begin : MarkEdge::end;
    mark.lane = id();
    mark.node = outputs_[o];
    mark.code = "detection";
    sink.mark(mark);
  }
  faults_.mark_edges(id(), outputs_, sink);
}

void Lane::append_metrics(std::vector<MetricValue>& metrics) const {
  score_.append_metrics(id(), metrics);
  attack_score_.append_metrics(id(), outputs_, metrics);
  input_score_.append_metrics(id(), outputs_, metrics);
  if (fusion_side_) fusion_side_->append_metrics(metrics);
  const bool alone = outputs_.size() == 1;
  for (std::size_t o = 0; o < detection_.size(); ++o)
    detection_[o].append_metrics(id(), alone ? "" : outputs_[o], twin_.has_value(), metrics);
  if (options_.side == Contender::Side::shared || !ports_.empty()) return;
  if (twin_) twin_score_.append_metrics(id(), "", metrics);
  state_score_.append_metrics(id(), options_.spared ? "" : "_attacked", metrics);
}

void Lane::retune(const Params& params) {
  method().retune(params);
  if (twin_) twin_->method().retune(params);
}

void Lane::retune_detector(const Params& params) {
  contender_.retune_detector(params);
  if (twin_) twin_->retune_detector(params);
}

void Lane::rewire(const Graph& graph, const std::vector<LinkRates>& rates) {
  const std::vector<LinkRates> mine = options_.spared ? std::vector<LinkRates>(rates.size()) : rates;
  contender_.rewire(graph, mine);
  if (twin_) twin_->rewire(graph, mine);
}

}  // namespace vigil
