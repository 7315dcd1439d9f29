#include "tests/engine/methods/rig.hpp"

namespace vigil::rig {

Knowledge knowledge_of(const Scenario& scenario, std::uint64_t seed) {
  const Json& document = scenario.document();
  Knowledge known;
  const auto& plant = document["plant"];
  known.plant = Registry<PlantMake>::find(plant["type"].get<std::string>())
                    ->make(Params(plant["params"]), document["time"]["dt"].get<double>());
  known.dt = document["time"]["dt"].get<double>();
  known.seed = seed;
  const int n = known.plant->states();
  Eigen::Matrix2Xd positions(2, static_cast<Eigen::Index>(document["nodes"].size()));
  for (const auto& [id, node] : document["nodes"].items()) {
    const auto& sensor = node["sensor"];
    known.sensors.push_back(
        Registry<SensorMake>::find(sensor["type"].get<std::string>())->make(Params(sensor["params"]), *known.plant));
    positions.col(static_cast<Eigen::Index>(known.nodes.size())) =
        known.sensors.back()->position().value_or(Eigen::Vector2d::Zero());
    known.nodes.push_back(id);
  }
  known.graph = read_network(document["network"], known.nodes, positions);
  known.Q = read_covariance(document["noise"]["Q"], n, "", Definiteness::semidefinite);
  known.P0 = read_covariance(document["noise"]["P0"], n, "", Definiteness::semidefinite);
  known.rates.resize(known.graph.links().size());
  known.estimates.resize(n, positions.cols());
  const Params initial(document["initial"]);
  const Eigen::MatrixXd root = symmetric_root(known.P0);
  Eigen::VectorXd draw(n);
  for (Eigen::Index i = 0; i < positions.cols(); ++i) {
    Draws(seed, "initial." + known.nodes[static_cast<std::size_t>(i)]).normals(0, draw);
    known.estimates.col(i) = initial.vector("truth") + root * draw;
  }
  return known;
}

void set_rates(Knowledge& known, const LinkRates& rate) { known.rates.assign(known.rates.size(), rate); }

Readings readings_at(const Knowledge& known, const Eigen::VectorXd& truth, std::uint64_t seed, std::int64_t k) {
  Readings readings;
  for (std::size_t i = 0; i < known.sensors.size(); ++i) {
    const Sensor& sensor = *known.sensors[i];
    Eigen::VectorXd z(sensor.size()), noise(sensor.size());
    sensor.measure(truth, z);
    Draws(seed, "sensor." + known.nodes[i]).normals(k, noise);
    readings.emplace_back(z + symmetric_root(sensor.noise()) * noise);
  }
  return readings;
}

Links::Links(const Knowledge& known)
    : state(known.graph.links().size(), LinkState::clean),
      injected(Eigen::MatrixXd::Zero(known.plant->states(), static_cast<Eigen::Index>(known.graph.links().size()))) {}

Links attacked(const Knowledge& known, std::uint64_t seed, std::int64_t k, double pdos, double pfdi, double size) {
  Links links(known);
  const Draws branch(seed, "branch"), signal(seed, "signal");
  for (std::size_t l = 0; l < links.state.size(); ++l) {
    const auto index = static_cast<std::uint32_t>(l);
    const double u = branch.uniform(k, index);
    if (u < pdos) links.state[l] = LinkState::dos;
    if (u < pdos || u >= pdos + pfdi) continue;
    links.state[l] = LinkState::fdi;
    for (Eigen::Index c = 0; c < 2; ++c)
      links.injected(c, static_cast<Eigen::Index>(l)) = size * std::sin(signal.normal(k, index));
  }
  return links;
}

void tick(Method& method, const Knowledge& known, const Readings& readings, const Links& links, FaultTable& faults,
          std::int64_t k) {
  faults.begin_tick(k);
  method.predict(Eigen::VectorXd::Zero(known.plant->inputs()), faults);
  if (faults.stopped()) return;
  method.measure(readings, faults);
  if (faults.stopped()) return;
  std::vector<Delivery> inbox(method.message() > 0 ? links.state.size() : 0);
  for (std::size_t l = 0; l < inbox.size(); ++l) {
    inbox[l].payload.resize(method.message());
    method.send(known.graph.links()[l].from, inbox[l].payload);
    inbox[l].lost = links.state[l] == LinkState::dos;
    inbox[l].flagged = links.state[l] == LinkState::fdi;
    if (inbox[l].flagged) inbox[l].payload += links.injected.col(static_cast<Eigen::Index>(l));
  }
  method.update(readings, inbox, faults);
}

Eigen::VectorXd mean(const Method& method, int output, int n) {
  return Eigen::Map<const Eigen::VectorXd>(method.belief(output).mean, n);
}

Eigen::MatrixXd bound(const Method& method, int output, int n) {
  return Eigen::Map<const Eigen::MatrixXd>(method.belief(output).covariance, n, n);
}

std::vector<FaultCount> faults_of(const FaultTable& table, const Method& method) {
  std::vector<FaultCount> faults;
  table.append("lane", method.outputs(), faults);
  return faults;
}

}  // namespace vigil::rig
