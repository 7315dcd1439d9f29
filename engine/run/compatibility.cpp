#include "engine/run/compatibility.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "engine/methods/fusion_method.hpp"
#include "engine/methods/privacy/protection.hpp"
#include "engine/run/design.hpp"
#include "engine/run/state.hpp"

namespace vigil {
namespace {

constexpr std::int64_t kTrialTick = 101;  // there is something to play back by then
constexpr ChannelKind kKinds[] = {ChannelKind::link, ChannelKind::sensor, ChannelKind::actuator};

/// A place of this kind in the run, and the sizes of what an attack may have to be told there; no sizes: there is none.
struct Where {
  std::string place;
  std::vector<int> sizes;
  std::string missing;  ///< why there is none
};

Where where(const TrialAccess::State& state, ChannelKind kind) {
  const int states = state.world.plant->states();
  const std::string& first = state.nodes.front();
  if (kind == ChannelKind::sensor) return {"sensor:" + first, {state.world.sensors.front()->size(), states}, ""};
  if (kind == ChannelKind::link) {
    if (state.base.links().empty()) return {"", {}, "the network has no links"};
    return {"link:*", {states}, ""};
  }
  if (const ContinuousPlant* plant = state.world.continuous()) {
    for (std::size_t i = 0; i < state.nodes.size(); ++i) {
      if (plant->ports()[i].w > 0) return {"actuator:" + state.nodes[i], {plant->ports()[i].w}, ""};
    }
    return {"", {}, "no subsystem has an actuator that could be attacked"};
  }
  if (state.world.controller == nullptr || state.world.plant->inputs() == 0)
    return {"", {}, "no controller drives the plant, so there are no commands"};
  return {"actuator:" + first, {state.world.plant->inputs()}, ""};
}

/// Parameters that have no default, or one of another size, made up: ones of this size, one piece of a signal.
Json made_up(const ParamTable& table, int size) {
  Json params = Json::object();
  for (const Param& param : table.all()) {
    const bool needed = param.required || (param.type == ParamType::vector && param.fallback.is_array());
    if (!needed) continue;
    if (param.type == ParamType::vector) params[param.name] = std::vector<double>(static_cast<std::size_t>(size), 1.0);
    if (param.type == ParamType::matrix) params[param.name] = Json::array({Json::array({1, 0, 0, 1, 0, 2, 0})});
  }
  return params;
}

/// The first parameters that the adversary accepts at this place; else the sentence of its last refusal.
struct Trial {
  std::optional<Json> params;
  std::string refusal;
};

Trial attempt(const TrialAccess::State& state, const Entry<AttackMake>& entry, const Where& where) {
  Trial trial;
  std::vector<Json> candidates{Json::object()};
  for (const int size : where.sizes) candidates.push_back(made_up(entry.params, size));
  for (const Json& params : candidates) {
    try {
      Adversary adversary = state.adversary;
      adversary.start({{"id", "trial"}, {"type", entry.id}, {"on", Json::array({where.place})}, {"params", params}},
                      kTrialTick);
      trial.params = params;
      return trial;
    } catch (const InputError& error) {
      trial.refusal = error.problems().front().detail;
    }
  }
  return trial;
}

Json meets(const char* what) { return {{"meets", what}, {"reason", nullptr}}; }
Json misses(const char* why) { return {{"meets", nullptr}, {"reason", why}}; }

Json cell(const Lane& lane, const std::string& attack, ChannelKind kind) {
  const Method& method = lane.method();
  if (lane.spared()) return misses("the lane is spared every attack (\"adversary\":false)");
  if (kind == ChannelKind::actuator) return meets("plant");
  if (kind == ChannelKind::sensor) {
    if (!method.reads()) return misses("it listens to no sensor");
    return meets(lane.monitors() ? "detector" : "estimate");
  }
  if (method.message() == 0) return misses("its nodes send no messages");
  if (attack != "eavesdrop") return meets("estimate");
  if (method.fusion() == nullptr)
    return misses("who listens is shown on the link; eavesdroppers estimate at a fusion centre only");
  if (method.fusion()->protection().published() != nullptr)
    return misses("its eavesdropper reads what the centre publishes, not the messages to it");
  return meets("messages");
}

Json row(const TrialAccess::State& state, const Entry<AttackMake>& entry, ChannelKind kind) {
  Json row{{"attack", entry.id},     {"title", {{"en", entry.title.en}, {"zh", entry.title.zh}}},
           {"channel", word(kind)},  {"place", nullptr},
           {"params", nullptr},      {"reason", nullptr},
           {"cells", Json::object()}};
  const auto& kinds = entry.traits.acts_on;
  if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end()) {
    row["reason"] = fmt::format("it does not act on {}s", word(kind));
    return row;
  }
  const Where at = where(state, kind);
  if (!at.missing.empty()) {
    row["reason"] = at.missing;
    return row;
  }
  const Trial trial = attempt(state, entry, at);
  row["place"] = at.place;
  if (!trial.params) {
    row["reason"] = trial.refusal;
    return row;
  }
  row["params"] = *trial.params;
  for (const Lane& lane : state.lanes) row["cells"][lane.id()] = cell(lane, entry.id, kind);
  return row;
}

}  // namespace

Json compatibility(const Scenario& scenario) {
  RunOptions options;
  for (const DesignTask& task : design_tasks(scenario)) options.designs[task.lane] = {{"key", task.key}};
  Run run(scenario, std::move(options));
  const TrialAccess::State& state = TrialAccess::state(run);
  Json table{{"lanes", Json::array()}, {"rows", Json::array()}};
  for (const Lane& lane : state.lanes) table["lanes"].push_back({{"id", lane.id()}, {"method", lane.method_id()}});
  for (const auto& entry : Registry<AttackMake>::all()) {
    for (const ChannelKind kind : kKinds) table["rows"].push_back(row(state, entry, kind));
  }
  return table;
}

}  // namespace vigil
