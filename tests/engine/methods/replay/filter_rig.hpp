/// A method of the replay family driven by hand: a system of any matrices, a record of readings and inputs.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "engine/methods/replay/system.hpp"
#include "tests/engine/linalg/random_matrices.hpp"
#include "tests/engine/methods/rig.hpp"

namespace vigil::replay::rig {

Knowledge knowledge_of(const System& s, std::uint64_t seed = 1);

std::unique_ptr<Method> make(const std::string& id, const Knowledge& known, const Json& params);

/// Readings y_1, y_2, … and the inputs that acted before them.
struct Record {
  std::vector<Eigen::VectorXd> y, u;
};

/// Inputs and readings that vary much: the filters do not ask where they come from.
Record record_of(const System& s, int ticks, std::uint64_t seed);

/// One tick: what leaves the sensor arrives, unless something else is given.
void tick(Method& method, const Eigen::VectorXd& y, const Eigen::VectorXd& u, FaultTable& faults, std::int64_t k,
          const Eigen::VectorXd* instead = nullptr);

/// A method's own signals by their names.
class Signals final : public SignalScope {
 public:
  explicit Signals(Method& method);
  int add(int /*output*/, const std::string& name, const std::string& /*unit*/, SignalKind /*kind*/) override;
  int add_category(int output, const std::string& name, const std::vector<std::string>& /*words*/) override;
  /// NaN where it says nothing.
  double operator()(const std::string& name) const;

 private:
  Method& method_;
  std::vector<std::string> names_;
};

Eigen::VectorXd estimate(const Method& method, int n);

}  // namespace vigil::replay::rig
