#include "tests/engine/methods/sparse/target.hpp"

namespace vigil::target {

Knowledge known(const Json& patch) {
  const Scenario scenario = Scenario::preset("sparse").patched(patch);
  Knowledge knowledge = rig::knowledge_of(scenario);
  const Eigen::VectorXd start = Params(scenario.document()["initial"]).vector("truth");
  knowledge.estimates = start.replicate(1, knowledge.estimates.cols());
  return knowledge;
}

Readings Target::next(const std::vector<int>& attacked) {
  Eigen::VectorXd ahead(x_.size());
  known_.plant->advance(x_, Eigen::VectorXd(), ahead);
  x_ = ahead + symmetric_root(known_.Q) * windows::normals(seed_, "plant", ++k_, static_cast<int>(x_.size()));
  Readings readings = rig::readings_at(known_, x_, seed_, k_);
  const Draws lie(seed_, "lie");
  for (const int i : attacked) {
    auto& y = readings[static_cast<std::size_t>(i)];
    y[0] += 10 * lie.uniform(k_, static_cast<std::uint32_t>(2 * i)) - 5;
    y[1] = windows::turned(y[1] + 6.28 * lie.uniform(k_, static_cast<std::uint32_t>(2 * i + 1)));
  }
  return readings;
}

std::unique_ptr<Method> method(const char* id, const Knowledge& known, const Json& params) {
  return Registry<MethodMake>::find(id)->make(rig::completed(id, params), known);
}

}  // namespace vigil::target
