/// A method driven by hand, without a run: what a scenario makes a node know, and the tick's calls in their order.
#pragma once

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "engine/linalg/covariance.hpp"
#include "engine/methods/consensus/filter.hpp"
#include "engine/methods/method.hpp"
#include "engine/random/draws.hpp"
#include "engine/run/fault_table.hpp"
#include "engine/run/state.hpp"
#include "engine/scenario/scenario.hpp"

namespace vigil::rig {

/// Knowledge of a scenario's nodes: initial estimates are drawn about initial.truth as a run does, rates are zero.
Knowledge knowledge_of(const Scenario& scenario, std::uint64_t seed = 1);

/// A method's parameters with their defaults; unknown ones fail the test that gives them.
template <class Make = MethodMake>
Params completed(const std::string& id, const Json& given = Json::object()) {
  std::vector<Problem> problems;
  const Json values = Registry<Make>::find(id)->params.complete(given, "", problems);
  if (!problems.empty()) throw InputError(std::move(problems));
  return Params(values);
}

void set_rates(Knowledge& known, const LinkRates& rate);

/// Readings of every sensor at `truth`, with noise of this seed and tick.
Readings readings_at(const Knowledge& known, const Eigen::VectorXd& truth, std::uint64_t seed, std::int64_t k);

/// What happens on each link in one tick.
struct Links {
  std::vector<LinkState> state;
  Eigen::MatrixXd injected;

  explicit Links(const Knowledge& known);
};

/// DoS below pdos, FDI of norm up to `size` below pdos + pfdi.
Links attacked(const Knowledge& known, std::uint64_t seed, std::int64_t k, double pdos, double pfdi, double size);

/// One tick of a method as a lane makes it.
void tick(Method& method, const Knowledge& known, const Readings& readings, const Links& links, FaultTable& faults,
          std::int64_t k);

Eigen::VectorXd mean(const Method& method, int output, int n);
Eigen::MatrixXd bound(const Method& method, int output, int n);

std::vector<FaultCount> faults_of(const FaultTable& table, const Method& method);

}  // namespace vigil::rig
