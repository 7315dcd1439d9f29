/// Lanes of a run: initial estimates, what each method may know, which plant each lane sees.
#include <fmt/format.h>

#include <algorithm>

#include "engine/core/missing.hpp"
#include "engine/linalg/covariance.hpp"
#include "engine/linalg/small.hpp"
#include "engine/methods/fusion_method.hpp"
#include "engine/run/design.hpp"
#include "engine/run/recorded_lane.hpp"
#include "engine/run/setup.hpp"
#include "engine/run/state.hpp"
#include "engine/run/stationary_start.hpp"

namespace vigil {
namespace {

Eigen::VectorXd read_vector(const Json& value, int size, const std::string& pointer) {
  if (!value.is_array() || static_cast<int>(value.size()) != size) {
    throw InputError(pointer, fmt::format("expected {} numbers, one a state", size));
  }
  Eigen::VectorXd vector(size);
  for (int i = 0; i < size; ++i) {
    const Json& item = value[static_cast<std::size_t>(i)];
    if (!item.is_number()) throw InputError(fmt::format("{}/{}", pointer, i), "expected a number");
    vector[i] = item.get<double>();
  }
  return vector;
}

ScoreWindow read_window(const Json& given) {
  ScoreWindow window;
  window.from = given.value("from", window.from);
  const Json to = given.value("to", Json(nullptr));
  if (to.is_number()) window.to = to.get<std::int64_t>();
  return window;
}

/// The document's "metrics". Throws InputError where a figure names a component that the plant has not.
ScoreRules read_rules(const Json& metrics, const Plant& plant) {
  ScoreRules rules;
  rules.window = read_window(metrics.value("window", Json::object()));
  const Json detection = metrics.value("detection", Json::object()), state = metrics.value("state", Json::object());
  rules.detection_from = detection.value("from", rules.detection_from);
  rules.state_from = state.value("from", rules.state_from);
  const Json figures = metrics.value("mse", Json::object());
  for (const auto& [name, figure] : figures.items()) {
    const auto component = figure.at("component").get<std::string>();
    std::vector<std::string> names;
    for (const Component& c : plant.state()) names.push_back(c.name);
    const auto found = std::find(names.begin(), names.end(), component);
    if (found == names.end()) {
      throw InputError("/metrics/mse/" + name + "/component",
                       fmt::format("component is \"{}\", which is no state of the plant", component),
                       fmt::format("{}", fmt::join(names, ", ")));
    }
    rules.mse.push_back({name, static_cast<int>(found - names.begin()), read_window(figure)});
  }
  return rules;
}

/// Null where the lane has none.
std::unique_ptr<privacy::Protection> make_protection(const Json& lane, const std::string& pointer,
                                                     const Knowledge& knowledge) {
  const Json given = lane.value("protection", Json::object());
  const std::string type = given.value("type", "none");
  if (type == "none") return nullptr;
  const auto& entry = entry_of<ProtectionMake>(type, pointer + "/protection/type");
  return under(pointer + "/protection/params", [&] { return entry.make(Params(given["params"]), knowledge); });
}

/// Throws InputError where there is nothing to protect, or no centre that could make sense of what is sent.
void check_protected(const privacy::Protection& protection, const Method& method, const Json& lane,
                     const std::string& pointer) {
  const std::string type = lane["protection"]["type"], name = lane["method"], at = pointer + "/protection/type";
  if (method.message() == 0)
    throw InputError(at, fmt::format("\"{}\" has nothing to protect: \"{}\" sends no messages", type, name), "none");
  if (protection.needs_centre() && method.fusion() == nullptr)
    throw InputError(
        at,
        fmt::format("\"{}\" needs a fusion centre that knows it; \"{}\" has none, expected gaussian_noise", type, name),
        "gaussian_noise");
}

/// Null where the lane has none attached.
std::unique_ptr<Detector> make_detector(const Json& lane, const std::string& pointer, const Method& method) {
  const Json given = lane.value("detector", Json::object());
  const std::string type = given.value("type", "none"), at = pointer + "/detector/type";
  if (type == "none") return nullptr;
  const std::string name = lane["method"];
  if (method.detects())
    throw InputError(at, fmt::format("\"{}\" has a detector of its own; expected none", name), "none");
  if (lane.value("path", "loop") == "monitor")
    throw InputError(at, "on the path monitor the estimator does not hear what arrives; expected path loop", "none");
  const auto& entry = entry_of<DetectorMake>(type, at);
  return under(pointer + "/detector/params", [&] { return entry.make(Params(given["params"])); });
}

}  // namespace

Eigen::MatrixXd Run::State::initial_estimates(const Json& initial, Knowledge& knowledge) {
  const Eigen::MatrixXd& P0 = knowledge.P0;
  const int n = world.plant->states();
  Eigen::VectorXd& truth = shared.truth;
  const Json given_truth = initial.value("truth", Json(nullptr));
  const bool begun = trace && trace->rows() > 0;  // one that grows may not have: then the run is made anew when it has
  truth = Eigen::VectorXd::Constant(n, begun ? kMissing : 0.0);
  for (int c = 0; begun && c < n; ++c) truth[c] = trace->at(0, columns.shared.truth[static_cast<std::size_t>(c)]);
  const bool recorded = begun && truth.allFinite();
  if (!given_truth.is_null() && !recorded) truth = read_vector(given_truth, n, "/initial/truth");

  const Json estimates = initial.value("estimates", Json(nullptr));
  Eigen::VectorXd centre = given_truth.is_null() ? truth : read_vector(given_truth, n, "/initial/truth");
  if (!centre.allFinite() && !estimates.is_object()) {
    throw InputError("/initial/truth",
                     "the trace has no truth in its first row, so initial.truth or initial.estimates must be given");
  }
  knowledge.prior = centre.allFinite() ? centre : Eigen::VectorXd::Zero(n);
  if (knowledge.stationary) {
    const bool drawn = initial.value("x0_random", false);
    const StationaryStart start(knowledge, drawn);
    if (drawn && !recorded) truth += start.deviation(n);
    return truth.replicate(1, world.sensors.size()) - start.errors(n);
  }
  const Eigen::MatrixXd root = symmetric_root(P0);
  if (initial.value("x0_random", false) && !trace) {
    Eigen::VectorXd draw(n);
    Draws(seed, "initial.truth").normals(0, draw);
    truth += root * draw;
  }
  Eigen::MatrixXd result(n, static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    if (estimates.is_object() && estimates.contains(nodes[i])) {
      result.col(column) = read_vector(estimates[nodes[i]], n, "/initial/estimates/" + nodes[i]);
      continue;
    }
    if (!centre.allFinite())
      throw InputError("/initial/estimates",
                       fmt::format("node \"{}\" has no initial estimate and the trace no truth", nodes[i]));
    Eigen::VectorXd draw(n);
    Draws(seed, "initial." + nodes[i]).normals(0, draw);
    result.col(column) = centre;
    if (!estimates.is_string()) result.col(column) += root * draw;  // "truth": exactly there
  }
  return result;
}

/// Which plant a lane sees. A trace with readings of the lane's own takes the place of the plant it would control; one
/// without drives it open loop, and what its sensors add is added to the trace's readings. In continuous time attacks
/// act on the plant itself: a lane that is spared has one that they do not reach.
Contender::Side Run::State::side_of(const std::string& lane, const Method& method, bool spared, bool judged) const {
  if (trace && course_columns("lane." + lane + ".").readings) return Contender::Side::recorded;
  if (trace) return method.marks() ? Contender::Side::marked : Contender::Side::shared;
  if (world.controller || (world.continuous() != nullptr && spared)) return Contender::Side::closed;
  if (world.continuous() != nullptr && method.continuous() != nullptr) return Contender::Side::shared;
  return method.marks() || method.detects() || judged ? Contender::Side::marked : Contender::Side::shared;
}

void Run::State::set_lanes(const Json& document) {
  const int n = world.plant->states();
  const Json& noise_document = document["noise"];
  Knowledge knowledge;
  knowledge.plant = world.plant;
  knowledge.dt = dt;
  knowledge.seed = seed;
  knowledge.sensors = world.sensors;
  knowledge.nodes = nodes;
  knowledge.graph = graph;
  knowledge.Q = read_covariance(noise_document.at("Q"), n, "/noise/Q", Definiteness::semidefinite);
  knowledge.P0 = read_covariance(noise_document.at("P0"), n, "/noise/P0", Definiteness::semidefinite);
  knowledge.Mw = read_covariance(noise_document.value("Mw", Json(0)), n, "/noise/Mw", Definiteness::semidefinite);
  const Json initial = document.value("initial", Json::object());
  knowledge.stationary = initial.value("estimates", Json(nullptr)) == "stationary";
  knowledge.estimates = initial_estimates(initial, knowledge);
  const std::vector<LinkRates> published = adversary.rates(graph);
  const ScoreRules rules = read_rules(document.value("metrics", Json::object()), *world.plant);
  for (const auto& [id, lane] : document["lanes"].items()) {
    if (!lane.value("enabled", true)) continue;
    const std::string pointer = "/lanes/" + id;
    LaneOptions options;
    options.id = id;
    options.method_id = lane["method"].get<std::string>();
    options.spared = !lane.value("adversary", true);
    options.monitor = lane.value("path", "loop") == "monitor";
    options.last = last_tick;
    options.params = lane["params"];
    options.rules = rules;
    knowledge.monitor = options.monitor;
    knowledge.rates = options.spared ? std::vector<LinkRates>(published.size()) : published;
    const auto& entry = entry_of<MethodMake>(options.method_id, pointer + "/method");
    knowledge.design = designs.value(id, Json(nullptr));
    if (n > kMaxSmall && Registry<DesignMake>::find(options.method_id) == nullptr) {
      throw InputError(pointer + "/method", fmt::format("\"{}\" runs on plants of at most {} states; this one has {}",
                                                        options.method_id, kMaxSmall, n));
    }
    auto protection = make_protection(lane, pointer, knowledge);
    knowledge.protection = protection ? protection->clone() : nullptr;
    auto made = under(pointer + "/params", [&] { return entry.make(Params(lane["params"]), knowledge); });
    if (protection) check_protected(*protection, *made, lane, pointer);
    if (made->fusion() != nullptr) protection.reset();  // the method encodes and decodes by itself
    const auto detector = make_detector(lane, pointer, *made);
    if (detector) options.detector = lane["detector"];
    options.side = side_of(id, *made, options.spared, detector != nullptr);
    lanes.emplace_back(std::move(options), std::move(made), std::move(protection), detector.get(), world, graph);
  }
  if (lanes.empty()) throw InputError("/lanes", "no lane is enabled; a run needs one");
  for (const Lane& lane : lanes) {
    if (trace) columns.lanes.push_back(course_columns("lane." + lane.id() + "."));
  }
}

void Run::State::set_recorded_lanes() {
  const ScoreRules rules = read_rules(scenario.document().value("metrics", Json::object()), *world.plant);
  for (auto& recorded : find_recorded_lanes(trace, scenario.document()["lanes"], *world.plant)) {
    LaneOptions options;
    options.id = recorded.lane;
    options.method_id = "recorded";
    options.spared = true;
    options.params = Json::object();
    options.rules = rules;
    lanes.emplace_back(std::move(options), std::move(recorded.method), nullptr, nullptr, world, graph);
  }
}

}  // namespace vigil
