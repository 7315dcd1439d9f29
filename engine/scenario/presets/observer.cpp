/// Seed 002: interconnected subsystems under actuator attacks and sensor faults.
#include "engine/scenario/presets/presets.hpp"
#include "engine/world/interconnected/examples.hpp"
#include "engine/world/interconnected/waveform.hpp"

namespace vigil::presets {
namespace {

using observer::Example;
using observer::Signal;

Json waveform(const Signal& signal, double horizon) {
  return {{"type", "waveform"}, {"params", {{"pieces", observer::write_pieces(signal, horizon)}}}};
}

Json nodes(const Example& example) {
  Json result = Json::object();
  for (std::size_t i = 0; i < example.signals.size(); ++i) {
    Json node = {{"sensor", {{"type", "subsystem"}, {"params", {{"number", i + 1}}}}}};
    const auto add = [&](const char* letter, const std::vector<Signal>& signals) {
      for (std::size_t c = 0; c < signals.size(); ++c)
        node["signals"][letter + std::to_string(c + 1)] = waveform(signals[c], example.horizon);
    };
    add("d", example.signals[i].d);
    add("f", example.signals[i].f);
    result[std::to_string(i + 1)] = std::move(node);
  }
  return result;
}

Json attack(std::size_t node, const Signal& signal, double horizon) {
  Json entry = waveform(signal, horizon);
  entry["on"] = Json::array({"actuator:" + std::to_string(node)});
  return entry;
}

Json lane(const Json& params) { return {{"method", "intermediate_observer"}, {"params", params}}; }

Json document(const char* id, Json title, const Example& example, Json plant) {
  Json truth = Json::array(), adversary = Json::object();
  for (const auto& x0 : example.x0) {
    for (const double value : x0) truth.push_back(value);
  }
  for (std::size_t i = 0; i < example.signals.size(); ++i) {
    if (!example.signals[i].w.empty())
      adversary["w" + std::to_string(i + 1)] = attack(i + 1, example.signals[i].w.front(), example.horizon);
  }
  return {{"vigil", 1},
          {"id", id},
          {"title", std::move(title)},
          {"source", "seed 002"},
          {"family", "observer"},
          {"time", {{"dt", example.dt}, {"steps", static_cast<int>(example.horizon / example.dt + 0.5)}}},
          {"plant", std::move(plant)},
          {"nodes", nodes(example)},
          {"network", {{"graph", "none"}}},
          {"noise", {{"Q", 0}, {"P0", 0}}},
          {"initial", {{"truth", std::move(truth)}}},
          {"adversary", std::move(adversary)},
          {"log", {{"signals", Json::array({"*"})}}}};
}

Json window(double from, const Example& example) {
  return {{"window", {{"from", static_cast<int>(from / example.dt + 0.5) + 1}}}};
}

}  // namespace

Json observer_pair() {
  const Example example = observer::pair();
  Json result = document("observer-pair",
                         {{"en", "Two coupled subsystems: state, attack and fault at once"},
                          {"zh", "两个耦合子系统：同时估计状态、攻击与故障"}},
                         example, {{"type", "pair"}});
  result["lanes"] = {{"intermediate_fast", lane({{"preset", "fast"}})},
                     {"intermediate_ref", lane({{"preset", "ref"}})},
                     {"intermediate_printed", lane({{"gains", "printed"}})}};
  result["metrics"] = window(8, example);
  result["view"] = {{"lane", "intermediate_fast"}};
  return result;
}

Json observer_areas() {
  const Example example = observer::areas(observer::AreaOutputs::case_1);
  Json result = document("observer-areas",
                         {{"en", "Four areas of a power network: against the matched observer"},
                          {"zh", "四区域电力系统：与匹配条件观测器的比较"}},
                         example, {{"type", "areas"}, {"params", {{"case", 1}, {"topology", "full"}}}});
  // The variant in which the matched observer fails: specification (observer), section 8.2.
  Json variant =
      attack(2, observer::areas(observer::AreaOutputs::case_1, observer::Topology::full, true).signals[1].w[0],
             example.horizon);
  variant["enabled"] = false;
  result["adversary"]["area2"] = std::move(variant);
  result["lanes"] = {{"intermediate_fast", lane({{"preset", "fast"}})},
                     {"intermediate_ref", lane({{"preset", "ref"}})},
                     {"matched_uio", {{"method", "matched_observer"}}}};
  result["view"] = {{"lane", "intermediate_fast"}};
  return result;
}

Json observer_single() {
  const Example example = observer::single();
  Json result =
      document("observer-single",
               {{"en", "One subsystem: against the classical estimator"}, {"zh", "单个子系统：与经典估计器的比较"}},
               example, {{"type", "single"}});
  result["lanes"] = {{"intermediate_fast", lane({{"preset", "fast"}})},
                     {"intermediate_ref", lane({{"preset", "ref"}})},
                     {"classical_fast", lane({{"preset", "fast"}, {"structure", "classical"}})},
                     {"classical_ref", lane({{"preset", "ref"}, {"structure", "classical"}})}};
  result["metrics"] = window(2, example);
  result["view"] = {{"lane", "intermediate_fast"}};
  return result;
}

}  // namespace vigil::presets
