#include "engine/run/system_model.hpp"

#include "engine/linalg/covariance.hpp"
#include "engine/linalg/small.hpp"
#include "engine/run/setup.hpp"
#include "engine/run/state.hpp"

namespace vigil {
namespace {

Eigen::VectorXd initial_truth(const Json& document, int states) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(states);
  const Json& given = document["initial"]["truth"];
  for (int i = 0; i < states && given.is_array(); ++i) x[i] = given[static_cast<std::size_t>(i)].get<double>();
  return x;
}

/// The plant's own derivative, and by differences what an input does.
LinearModel linearised(const Plant& plant, const Eigen::VectorXd& x) {
  const int n = plant.states(), m = plant.inputs();
  LinearModel model{Eigen::MatrixXd(n, n), Eigen::MatrixXd(n, m)};
  Eigen::VectorXd u = Eigen::VectorXd::Zero(m), above(n), below(n);
  plant.jacobian(x, u, model.A);
  constexpr double kStep = 1e-6;
  for (int i = 0; i < m; ++i) {
    u[i] = kStep;
    plant.advance(x, u, above);
    u[i] = -kStep;
    plant.advance(x, u, below);
    u[i] = 0;
    model.B.col(i) = (above - below) / (2 * kStep);
  }
  return model;
}

void set_model(const Json& document, SystemModel& system) {
  const Plant& plant = *system.plant;
  if (const ContinuousPlant* flow = plant.continuous()) {
    system.kind = ModelKind::continuous;
    system.model = flow->linear_part();
  } else if (plant.linear()) {
    system.model = linear_model(plant);
    const Json& params = document["plant"]["params"];
    if (params.value("time", "") == "continuous") {
      system.kind = ModelKind::sampled;
      system.given_A = Params(params).matrix("A");
    }
  } else {
    system.kind = ModelKind::linearised;
    system.model = linearised(plant, initial_truth(document, plant.states()));
  }
}

void set_nodes(const Json& document, SystemModel& system) {
  const int n = system.plant->states();
  const Eigen::VectorXd x = initial_truth(document, n);
  Eigen::Matrix2Xd positions = Eigen::Matrix2Xd::Zero(2, static_cast<Eigen::Index>(document["nodes"].size()));
  for (const auto& [id, node] : document["nodes"].items()) {
    const Json& sensor = node["sensor"];
    const std::string pointer = "/nodes/" + id + "/sensor";
    const auto& entry = entry_of<SensorMake>(sensor["type"].get<std::string>(), pointer + "/type");
    const auto made = under(pointer + "/params", [&] { return entry.make(Params(sensor["params"]), *system.plant); });
    check_covariance(made->noise(), pointer + "/params/R",
                     made->may_be_exact() ? Definiteness::semidefinite : Definiteness::definite);
    if (const auto place = made->position()) positions.col(static_cast<Eigen::Index>(system.nodes.size())) = *place;
    Eigen::MatrixXd C(made->size(), n);
    made->jacobian(x, C);
    system.C.push_back(std::move(C));
    system.sensors.push_back(made);
    system.nodes.push_back(id);
  }
  system.graph = read_network(document["network"], system.nodes, positions);
}

}  // namespace

SystemModel system_model(const Scenario& scenario) {
  const Json& document = scenario.document();
  const auto& entry = entry_of<PlantMake>(document["plant"]["type"].get<std::string>(), "/plant/type");
  const double dt = document["time"]["dt"].get<double>();
  SystemModel system;
  system.plant = under("/plant/params", [&] { return entry.make(Params(document["plant"]["params"]), dt); });
  set_model(document, system);
  const Json& controller = document["controller"];
  if (controller["type"] != "none") {
    if (system.plant->continuous() != nullptr)
      throw InputError("/controller/type", "a plant in continuous time has no controller; expected none", "none");
    const auto& kind = entry_of<ControllerMake>(controller["type"].get<std::string>(), "/controller/type");
    system.controller =
        under("/controller/params", [&] { return kind.make(Params(controller["params"]), *system.plant); });
  }
  set_nodes(document, system);
  return system;
}

Eigen::MatrixXd stacked(const std::vector<Eigen::MatrixXd>& C, int states) {
  Eigen::Index rows = 0;
  for (const auto& block : C) rows += block.rows();
  Eigen::MatrixXd whole(rows, states);
  rows = 0;
  for (const auto& block : C) {
    whole.middleRows(rows, block.rows()) = block;
    rows += block.rows();
  }
  return whole;
}

}  // namespace vigil
