/// From a document, a seed and perhaps a trace to a run that can be stepped.
#include "engine/run/setup.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "engine/core/missing.hpp"
#include "engine/linalg/covariance.hpp"
#include "engine/linalg/small.hpp"
#include "engine/run/sensor_signals.hpp"
#include "engine/run/state.hpp"

namespace vigil {
namespace {

constexpr std::int64_t kRecordLimit =
    40'000;  // cells (ticks x nodes) of a lane's bound record: enough for the papers, bounded for the rest

int node_index(const Json& id, const std::vector<std::string>& nodes, const std::string& pointer) {
  const std::string name = id.is_string() ? id.get<std::string>() : id.dump();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i] == name) return static_cast<int>(i);
  }
  throw InputError(pointer, fmt::format("there is no node \"{}\"", name));
}

std::vector<int> channel_counts(const std::vector<std::shared_ptr<const Sensor>>& sensors) {
  std::vector<int> counts;
  for (const auto& sensor : sensors) counts.push_back(sensor->size());
  return counts;
}

}  // namespace

Graph read_network(const Json& network, const std::vector<std::string>& nodes, const Eigen::Matrix2Xd& positions) {
  const std::string name = network.value("graph", "none");
  if (name != "edges") return make_graph(name, positions);
  std::vector<std::pair<int, int>> edges;
  const Json& list = network.at("edges");
  for (std::size_t e = 0; e < list.size(); ++e) {
    const std::string pointer = fmt::format("/network/edges/{}", e);
    edges.emplace_back(node_index(list[e][0], nodes, pointer + "/0"), node_index(list[e][1], nodes, pointer + "/1"));
  }
  return {static_cast<int>(nodes.size()), edges};
}

Run::State::State(const Scenario& given, RunOptions options)
    : scenario(given),
      seed(options.seed),
      trace(std::move(options.trace)),
      pending(std::move(options.commands)),
      designs(std::move(options.designs)) {
  std::stable_sort(pending.begin(), pending.end(),
                   [](const Command& one, const Command& other) { return one.k < other.k; });
  const Json& document = scenario.document();
  dt = document.at("time").at("dt").get<double>();
  if (!document["time"]["steps"].is_null()) last_tick = document["time"]["steps"].get<std::int64_t>();
  if (trace) check_trace(document);
  set_world(document);
  find_columns();
  std::vector<std::vector<std::string>> names;
  for (const auto& sensor : world.sensors) {
    names.emplace_back();
    for (const Component& channel : sensor->channels()) names.back().push_back(channel.name);
  }
  std::vector<std::vector<std::string>> actuators(nodes.size());
  if (const ContinuousPlant* plant = world.continuous()) {
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      for (int c = 1; c <= plant->ports()[i].w; ++c) actuators[i].push_back(fmt::format("w{}", c));
    }
  } else if (world.controller != nullptr) {
    for (const Component& u : world.plant->input()) actuators.front().push_back(u.name);
  }
  adversary = Adversary(document.value("adversary", Json::object()), base, nodes, names, actuators, seed,
                        world.plant->states(), world.continuous() != nullptr);
  set_lanes(document);
  if (trace) set_recorded_lanes();
  declare_signals();
}

void Run::State::set_world(const Json& document) {
  const auto& plant_entry = entry_of<PlantMake>(document["plant"]["type"].get<std::string>(), "/plant/type");
  world.plant = under("/plant/params", [&] { return plant_entry.make(Params(document["plant"]["params"]), dt); });
  const int n = world.plant->states();
  world.dt = dt;
  if (n > kMaxSmall && world.continuous() == nullptr)
    throw InputError("/plant", fmt::format("the plant has {} states; at most {} are supported", n, kMaxSmall));
  const Json& controller = document["controller"];
  if (controller["type"] != "none") {
    if (world.continuous() != nullptr)
      throw InputError("/controller/type", "a plant in continuous time has no controller; expected none", "none");
    const auto& entry = entry_of<ControllerMake>(controller["type"].get<std::string>(), "/controller/type");
    world.controller =
        under("/controller/params", [&] { return entry.make(Params(controller["params"]), *world.plant); });
  }
  set_nodes(document);
  set_noise(document);
  if (const ContinuousPlant* plant = world.continuous()) {
    plant->check_nodes(nodes, world.sensors);
    world.drive = Drive(*plant, document["nodes"]);
  }
  base = read_network(document["network"], nodes, positions);
  graph = base;
  base_of.resize(base.links().size());
  for (std::size_t l = 0; l < base_of.size(); ++l) base_of[l] = static_cast<int>(l);
  if (!base.connected() && !base.links().empty())
    warnings.emplace_back("the network is not connected: its parts never hear of each other");
  effects.resize(n, static_cast<int>(base.links().size()));
  sensor_effects.resize(channel_counts(world.sensors));
  shared = Course(world);
  channels = SensorChannels(world.sensors, last_tick);
}

void Run::State::set_nodes(const Json& document) {
  const Json& node_documents = document["nodes"];
  positions = Eigen::Matrix2Xd::Zero(2, static_cast<Eigen::Index>(node_documents.size()));
  for (const auto& [id, node] : node_documents.items()) {
    const Json& sensor = node["sensor"];
    const std::string pointer = "/nodes/" + id + "/sensor";
    Json params = sensor["params"];
    if (trace && params.contains("position") &&
        params["position"].is_null()) {  // a recording brings its survey in row 0
      const int x = trace->find("node." + id + ".position.x"), y = trace->find("node." + id + ".position.y");
      if (x >= 0 && y >= 0) params["position"] = {trace->at(0, x), trace->at(0, y)};
    }
    const auto& entry = entry_of<SensorMake>(sensor["type"].get<std::string>(), pointer + "/type");
    auto made = under(pointer + "/params", [&] { return entry.make(Params(params), *world.plant); });
    check_covariance(made->noise(), pointer + "/params/R",
                     made->may_be_exact() ? Definiteness::semidefinite : Definiteness::definite);
    if (made->size() > kMaxSmall && world.continuous() == nullptr)
      throw InputError(pointer, fmt::format("a sensor has at most {} channels", kMaxSmall));
    if (const auto place = made->position()) {
      positions.col(static_cast<Eigen::Index>(nodes.size())) = *place;
      placed = true;
    }
    world.sensors.push_back(std::move(made));
    nodes.push_back(id);
  }
}

/// The random and the bounded part of every noise, by the laws of the document.
void Run::State::set_noise(const Json& document) {
  const Json& noise = document["noise"];
  const int n = world.plant->states();
  const Law law = law_of(noise.value("law", "gauss"));
  const BoundedLaw bounded = bounded_law_of(noise.value("bounded", "uniform"));
  const Eigen::MatrixXd Q = read_covariance(noise.at("Q"), n, "/noise/Q", Definiteness::semidefinite);
  const Eigen::MatrixXd Mw = read_covariance(noise.value("Mw", Json(0)), n, "/noise/Mw", Definiteness::semidefinite);
  world.process_noise = NoiseSource(Q, law, Mw, bounded, seed, "plant");
  world.process_covariance = Q + Mw / (static_cast<double>(n) + 2);
  world.process = Eigen::VectorXd::Zero(n);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Sensor& sensor = *world.sensors[i];
    world.sensor_noise.emplace_back(sensor.noise(), law, sensor.bounded_noise(), bounded, seed, "sensor." + nodes[i]);
    world.sensing.emplace_back(Eigen::VectorXd::Zero(sensor.size()));
  }
}

std::vector<std::string> drive_names(const World& world, const std::vector<std::string>& nodes) {
  std::vector<std::string> names;
  const ContinuousPlant* plant = world.continuous();
  if (plant == nullptr) {
    if (world.controller == nullptr) return names;
    for (const Component& u : world.plant->input())
      names.push_back(fmt::format("actuator.{}.{}.injected", nodes.front(), u.name));
    return names;
  }
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const DrivePorts& ports = plant->ports()[i];
    names.insert(names.end(), static_cast<std::size_t>(ports.u), "");
    for (int c = 1; c <= ports.w; ++c) names.push_back(fmt::format("actuator.{}.w{}.injected", nodes[i], c));
    for (int c = 1; c <= ports.d; ++c) names.push_back(fmt::format("disturbance.{}.d{}", nodes[i], c));
    for (int c = 1; c <= ports.f; ++c) names.push_back(fmt::format("fault.{}.f{}", nodes[i], c));
  }
  return names;
}

void Run::State::declare_drives() {
  for (const std::string& name : drive_names(world, nodes)) {
    if (name.empty()) {
      slots.drives.push_back(-1);
      continue;
    }
    const std::size_t dot = name.find('.');
    const std::string node = name.substr(dot + 1, name.find('.', dot + 1) - dot - 1);
    slots.drives.push_back(catalogue.add({.name = name, .node = node}));
  }
}

void Run::State::declare_signals() {
  const auto add = [&](const std::string& name, const std::string& unit, SignalKind kind, const std::string& node,
                       const std::string& link) {
    Signal signal{.name = name, .unit = unit, .kind = kind, .node = node, .link = link};
    if (kind == SignalKind::category) signal.labels = {{0, "clean"}, {1, "DoS"}, {2, "FDI"}, {3, "replay"}};
    return catalogue.add(std::move(signal));
  };
  slots.truth = catalogue.size();
  for (const Component& c : world.plant->state()) add("truth." + c.name, c.unit, SignalKind::scalar, "", "");
  slots.input = catalogue.size();
  for (const Component& c : world.plant->input()) add("input." + c.name, c.unit, SignalKind::scalar, "", "");
  slots.sensor = declare_sensors("", "", nodes, world, catalogue);
  declare_drives();
  for (const Link& link : base.links()) {
    const std::string id = link_name(link, nodes);
    slots.link.push_back(add("link." + id + ".state", "", SignalKind::category, "", id));
    for (const Component& c : world.plant->state())
      add("link." + id + ".injected." + c.name, c.unit, SignalKind::scalar, "", id);
    add("link." + id + ".strength", "", SignalKind::scalar, "", id);
    add("link." + id + ".source", "", SignalKind::scalar, "", id);
    add("link." + id + ".overheard", "", SignalKind::boolean, "", id);
  }
  for (Lane& lane : lanes) lane.declare(world, nodes, catalogue);
  frame.values.assign(static_cast<std::size_t>(catalogue.size()), kMissing);
  if (last_tick && *last_tick * static_cast<std::int64_t>(nodes.size()) <= kRecordLimit) {
    for (Lane& lane : lanes) lane.record_bounds(*last_tick);
  }
}

}  // namespace vigil
