#include "engine/methods/replay/system.hpp"

#include "engine/core/describe.hpp"
#include "engine/linalg/riccati.hpp"
#include "engine/world/controller.hpp"

namespace vigil::replay {

System read_system(const Knowledge& knowledge) {
  if (knowledge.sensors.size() != 1)
    throw InputError(
        "/", "this method watches one sensor; the scenario has " + std::to_string(knowledge.sensors.size()) + " nodes",
        "one node");
  const Sensor& sensor = *knowledge.sensors.front();
  if (!knowledge.plant->linear() || !sensor.linear())
    throw InputError("/", "this method needs a linear plant and a linear sensor");
  const LinearModel model = linear_model(*knowledge.plant);
  System system{model.A,
                model.B,
                Eigen::MatrixXd(sensor.size(), model.A.rows()),
                knowledge.Q,
                sensor.noise(),
                knowledge.Mw,
                sensor.bounded_noise()};
  sensor.jacobian(Eigen::VectorXd::Zero(model.A.rows()), system.C);
  if (!detectable(system.A, system.C))
    throw InputError("/", named("C", system.C) +
                              ", which does not see a mode of the plant that does not decay; expected a detectable "
                              "pair (A, C)");
  return system;
}

Json to_json(const Eigen::MatrixXd& matrix) {
  Json rows = Json::array();
  for (Eigen::Index r = 0; r < matrix.rows(); ++r) {
    rows.push_back(Json::array());
    for (Eigen::Index c = 0; c < matrix.cols(); ++c) rows.back().push_back(matrix(r, c));
  }
  return rows;
}

std::string named(const char* name, const Eigen::MatrixXd& matrix) {
  return std::string(name) + " is " + shown(to_json(matrix));
}

}  // namespace vigil::replay
