/// A method of the replay family driven by hand: a system of any matrices, a record of readings and inputs.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "engine/methods/replay/system.hpp"
#include "tests/engine/linalg/random_matrices.hpp"
#include "tests/engine/methods/rig.hpp"

namespace vigil::replay::rig {

inline Json json(const Eigen::MatrixXd& matrix) { return to_json(matrix); }

inline Knowledge knowledge_of(const System& s, std::uint64_t seed = 1) {
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

inline std::unique_ptr<Method> make(const std::string& id, const Knowledge& known, const Json& params) {
  return Registry<MethodMake>::find(id)->make(vigil::rig::completed<MethodMake>(id, params), known);
}

/// Readings y_1, y_2, … and the inputs that acted before them.
struct Record {
  std::vector<Eigen::VectorXd> y, u;
};

/// Inputs and readings that vary much: the filters do not ask where they come from.
inline Record record_of(const System& s, int ticks, std::uint64_t seed) {
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

/// One tick: what leaves the sensor arrives, unless something else is given.
inline void tick(Method& method, const Eigen::VectorXd& y, const Eigen::VectorXd& u, FaultTable& faults, std::int64_t k,
                 const Eigen::VectorXd* instead = nullptr) {
  Readings arrived{y};
  faults.begin_tick(k);
  method.emit(0, y, u, arrived[0]);
  if (instead != nullptr) arrived[0] = *instead;
  method.predict(u, faults);
  method.measure(arrived, faults);
  method.judge(arrived, faults);
}

/// A method's own signals by their names.
class Signals final : public SignalScope {
 public:
  explicit Signals(Method& method) : method_(method) { method.declare(*this); }
  int add(int /*output*/, const std::string& name, const std::string& /*unit*/, SignalKind /*kind*/) override {
    names_.push_back(name);
    return static_cast<int>(names_.size()) - 1;
  }
  int add_category(int output, const std::string& name, const std::vector<std::string>& /*words*/) override {
    return add(output, name, "", SignalKind::category);
  }
  /// NaN where it says nothing.
  double operator()(const std::string& name) const {
    std::vector<double> values(names_.size(), std::numeric_limits<double>::quiet_NaN());
    method_.publish(values);
    const auto found = std::find(names_.begin(), names_.end(), name);
    EXPECT_NE(found, names_.end()) << name;
    return found == names_.end() ? 0 : values[static_cast<std::size_t>(found - names_.begin())];
  }

 private:
  Method& method_;
  std::vector<std::string> names_;
};

inline Eigen::VectorXd estimate(const Method& method, int n) {
  return Eigen::Map<const Eigen::VectorXd>(method.belief(0).mean, n);
}

}  // namespace vigil::replay::rig
