#include "tests/engine/runs/replay_rig.hpp"

namespace vigil::test {

Scenario replay_scenario(const std::string& preset, const std::vector<std::string>& lanes, const Json& patch) {
  Json document = Scenario::preset(preset).document();
  document.merge_patch(patch);
  if (!lanes.empty()) {
    Json few = Json::object();
    for (const std::string& id : lanes) few[id] = document.at("lanes").at(id);
    document["lanes"] = few;
  }
  return Scenario::from_json(document);
}

Told::Told(const Scenario& scenario, RunOptions options) : run(scenario, std::move(options)) {
  run_to_end(run, capture);
}

double Told::at(std::int64_t k, const std::string& signal) const {
  const int id = run.catalogue().find(signal);
  EXPECT_GE(id, 0) << signal;
  return id < 0 ? 0 : capture.frames[static_cast<std::size_t>(k)].values[static_cast<std::size_t>(id)];
}

double Told::of(const std::string& lane, std::int64_t k, const std::string& what) const {
  const bool own = what.starts_with("truth") || what.starts_with("input") || what.starts_with("sensor") ||
                   what.starts_with("actuator");
  return at(k, "lane." + lane + (own ? "." : ".1.") + what);
}

double Told::metric(const std::string& lane, const std::string& name, const std::string& variant) const {
  for (const MetricValue& m : run.metrics()) {
    if (m.lane == lane && m.name == name && m.variant == variant && m.node.empty()) return m.value;
  }
  ADD_FAILURE() << "no metric " << name << " of " << lane;
  return 0;
}

bool Told::has_metric(const std::string& lane, const std::string& name) const {
  const auto metrics = run.metrics();
  return std::any_of(metrics.begin(), metrics.end(),
                     [&](const MetricValue& m) { return m.lane == lane && m.name == name; });
}

std::vector<Mark> Told::marks(MarkType type, const std::string& code) const {
  std::vector<Mark> found;
  for (const Mark& mark : capture.marks) {
    if (mark.type == type && (code.empty() || mark.code == code)) found.push_back(mark);
  }
  return found;
}

Json replay_case(int number) { return {{"adversary", {{"replay", {{"params", {{"case", number}}}}}}}}; }

Json no_attack() { return {{"adversary", {{"replay", nullptr}}}}; }

InputError refusal(const Scenario& scenario, const RunOptions& options) {
  try {
    const vigil::Run run(scenario, options);
  } catch (const InputError& error) {
    return error;
  }
  ADD_FAILURE() << "accepted";
  return {"", ""};
}

}  // namespace vigil::test
