#include "engine/run/run.hpp"

#include <algorithm>
#include <cmath>

#include "engine/run/state.hpp"
#include "engine/run/system_words.hpp"

namespace vigil {

Run::Run(const Scenario& scenario, RunOptions options) : state_(std::make_unique<State>(scenario, std::move(options))) {
  std::vector<std::string> more = world_warnings(state_->world, state_->trace != nullptr);
  state_->warnings.insert(state_->warnings.end(), more.begin(), more.end());
}
Run::Run(const Run& other) : state_(std::make_unique<State>(*other.state_)) {}
Run::Run(Run&& other) noexcept = default;
Run& Run::operator=(Run other) noexcept {
  state_ = std::move(other.state_);
  return *this;
}
Run::~Run() = default;

const Catalogue& Run::catalogue() const { return state_->catalogue; }
const Scenario& Run::scenario() const { return state_->scenario; }
std::uint64_t Run::seed() const { return state_->seed; }
double Run::dt() const { return state_->dt; }
std::optional<std::int64_t> Run::steps() const { return state_->last_tick; }
std::int64_t Run::tick() const { return state_->k; }

void Run::step(Sink& sink) {
  if (done()) return;
  const Trace* trace = state_->trace.get();
  if (trace != nullptr && trace->grows()) {
    if (trace->rows() <= state_->k + 1) return;
    if (state_->k < 0) begin_anew();
  }
  state_->step(sink);
}

/// Estimates and lanes computed elsewhere start from the first row of a trace, which one that grows had not at first.
void Run::begin_anew() {
  State& now = *state_;
  *this = Run(now.scenario, RunOptions{now.seed, std::move(now.trace), std::move(now.pending), std::move(now.designs)});
}

bool Run::done() const {
  if (state_->last_tick && state_->k >= *state_->last_tick) return true;
  if (state_->k < 0) return false;
  for (const Lane& lane : state_->lanes) {
    if (!lane.stopped()) return false;
  }
  return true;
}

Command Run::prepare(const Json& body, std::optional<std::int64_t> at) const {
  Command command{at.value_or(state_->k + 1), body};
  if (done()) throw InputError("", "the run has ended; nothing can be changed any more");
  State trial(*state_);  // a command that fails must leave the run as it was
  for (const Command& before : state_->pending) {
    if (before.k <= command.k) trial.change(before, nullptr);
  }
  if (body.is_object() && body.contains("attack") && body["attack"].is_object() && !body["attack"].contains("id")) {
    command.body["attack"]["id"] = trial.adversary.free_id();
  }
  trial.change(command, nullptr);
  return command;
}

void Run::apply(const Command& command) {
  auto& pending = state_->pending;
  const auto later = [](const Command& one, const Command& other) { return one.k < other.k; };
  pending.insert(std::upper_bound(pending.begin(), pending.end(), command, later), command);
}

std::vector<MetricValue> Run::metrics() const {
  std::vector<MetricValue> metrics;
  for (const Lane& lane : state_->lanes) {
    lane.append_metrics(metrics);
    for (const OwnMetric& own : lane.method().metrics()) {
      metrics.push_back({lane.id(), own.output >= 0 ? lane.outputs()[static_cast<std::size_t>(own.output)] : "",
                         own.name, own.variant, own.value, own.boolean});
    }
    std::vector<FaultCount> faults;
    lane.faults().append(lane.id(), lane.outputs(), faults);
    double count = 0;
    for (const FaultCount& fault : faults) count += static_cast<double>(fault.count);
    metrics.push_back({lane.id(), "", "faults", "", count, false});
  }
  return metrics;
}

std::vector<FaultCount> Run::faults() const {
  std::vector<FaultCount> faults;
  for (const Lane& lane : state_->lanes) lane.faults().append(lane.id(), lane.outputs(), faults);
  return faults;
}

std::vector<std::string> Run::warnings() const {
  std::vector<std::string> warnings = state_->warnings;
  for (const Lane& lane : state_->lanes) {
    if (lane.contender().attached() && state_->k > 0 && !lane.contender().has_judged())
      warnings.push_back("lane " + lane.id() +
                         ": its detector has had nothing to judge: no innovation with a covariance");
    for (const std::string& warning : lane.method().warnings())
      warnings.push_back("lane " + lane.id() + ": " + warning);
  }
  return warnings;
}

Json Run::design() const {
  Json design = Json::object();
  for (const Lane& lane : state_->lanes) {
    Json mine = lane.method().design();
    int channels = state_->world.sensors.front()->size();
    if (lane.outputs().front() == "fused") {  // one innovation of every sensor
      channels = 0;
      for (const auto& sensor : state_->world.sensors) channels += sensor->size();
    }
    mine.update(lane.score().bounds(channels));
    if (const FusionSide* side = lane.fusion_side()) mine.update(side->traces());
    design[lane.id()] = std::move(mine);
  }
  return design;
}

Json Run::world() const {
  const State& s = *state_;
  Json world{{"nodes", Json::array()}, {"links", Json::array()}, {"lanes", Json::array()}, {"state", Json::array()}};
  for (std::size_t i = 0; i < s.nodes.size(); ++i) {
    const auto place = s.world.sensors[i]->position();
    world["nodes"].push_back(
        {{"id", s.nodes[i]}, {"position", place ? Json{(*place)[0], (*place)[1]} : Json(nullptr)}});
  }
  for (const Link& link : s.graph.links()) {
    const std::string& from = s.nodes[static_cast<std::size_t>(link.from)];
    const std::string to = link.to == s.graph.centre() ? kCentre : s.nodes[static_cast<std::size_t>(link.to)];
    world["links"].push_back({{"id", link_name(link, s.nodes)}, {"from", from}, {"to", to}});
  }
  if (s.graph.centre() >= 0) world["centre"] = kCentre;
  for (const Lane& lane : s.lanes)
    world["lanes"].push_back({{"id", lane.id()}, {"method", lane.method_id()}, {"adversary", !lane.spared()}});
  for (const Component& c : s.world.plant->state()) world["state"].push_back({{"name", c.name}, {"unit", c.unit}});
  return world;
}

Json to_json(const MetricValue& metric) {
  const auto text = [](const std::string& value) { return value.empty() ? Json(nullptr) : Json(value); };
  Json value(nullptr);
  if (std::isfinite(metric.value)) value = metric.boolean ? Json(metric.value != 0) : Json(metric.value);
  return {{"lane", text(metric.lane)},
          {"node", text(metric.node)},
          {"name", metric.name},
          {"variant", text(metric.variant)},
          {"value", value}};
}

Json to_json(const FaultCount& fault) {
  return {{"lane", fault.lane},       {"node", fault.node.empty() ? Json(nullptr) : Json(fault.node)},
          {"code", fault.code},       {"first", fault.first},
          {"last", fault.last},       {"count", fault.count},
          {"stopped", fault.stopped}, {"detail", fault.detail}};
}

}  // namespace vigil
