#include "tests/engine/methods/replay/filter_rig.hpp"

#include <algorithm>
#include <limits>

namespace vigil::replay::rig {
namespace {

Json json(const Eigen::MatrixXd& matrix) { return to_json(matrix); }

}  // namespace

Knowledge knowledge_of(const System& s, std::uint64_t seed) {
  Knowledge known;
  Json plant = {{"A", json(s.A)}};
  if (s.B.cols() > 0) plant["B"] = json(s.B);
  known.plant = Registry<PlantMake>::find("linear")->make(vigil::rig::completed<PlantMake>("linear", plant), 1);
  const Json sensor = {{"C", json(s.C)}, {"R", json(s.R)}, {"Mv", json(s.Mv)}};
  known.sensors = {
      Registry<SensorMake>::find("linear")->make(vigil::rig::completed<SensorMake>("linear", sensor), *known.plant)};
  known.nodes = {"1"};
  known.graph = Graph(1, {});
  known.Q = s.P;
  known.Mw = s.Mw;
  known.P0 = Eigen::MatrixXd::Zero(s.states(), s.states());
  known.estimates = Eigen::MatrixXd::Ones(s.states(), 1);
  known.seed = seed;
  return known;
}

Signals::Signals(Method& method) : method_(method) { method.declare(*this); }

int Signals::add(int /*output*/, const std::string& name, const std::string& /*unit*/, SignalKind /*kind*/) {
  names_.push_back(name);
  return static_cast<int>(names_.size()) - 1;
}

int Signals::add_category(int output, const std::string& name, const std::vector<std::string>& /*words*/) {
  return add(output, name, "", SignalKind::category);
}

std::unique_ptr<Method> make(const std::string& id, const Knowledge& known, const Json& params) {
  return Registry<MethodMake>::find(id)->make(vigil::rig::completed<MethodMake>(id, params), known);
}

Record record_of(const System& s, int ticks, std::uint64_t seed) {
  RandomMatrices random(seed);
  Record record;
  Eigen::VectorXd x = Eigen::VectorXd::Ones(s.states());
  for (int k = 0; k < ticks; ++k) {
    record.u.emplace_back(2 * random.gaussian(static_cast<int>(s.B.cols()), 1));
    x = s.A * x + s.B * record.u.back() + 0.4 * random.gaussian(s.states(), 1);
    record.y.emplace_back(s.C * x + 0.4 * random.gaussian(s.channels(), 1));
  }
  return record;
}

void tick(Method& method, const Eigen::VectorXd& y, const Eigen::VectorXd& u, FaultTable& faults, std::int64_t k,
          const Eigen::VectorXd* instead) {
  Readings arrived{y};
  faults.begin_tick(k);
  method.emit(0, y, u, arrived[0]);
  if (instead != nullptr) arrived[0] = *instead;
  method.predict(u, faults);
  method.measure(arrived, faults);
  method.judge(arrived, faults);
}

double Signals::operator()(const std::string& name) const {
  std::vector<double> values(names_.size(), std::numeric_limits<double>::quiet_NaN());
  method_.publish(values);
  const auto found = std::find(names_.begin(), names_.end(), name);
  EXPECT_NE(found, names_.end()) << name;
  return found == names_.end() ? 0 : values[static_cast<std::size_t>(found - names_.begin())];
}

Eigen::VectorXd estimate(const Method& method, int n) {
  return Eigen::Map<const Eigen::VectorXd>(method.belief(0).mean, n);
}

}  // namespace vigil::replay::rig
