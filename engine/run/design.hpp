/// What must be solved before a run can start: observer gains, one problem a lane. The engine says what is to be solved
/// and checks what comes back; whoever owns processes and time solves it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/core/json.hpp"
#include "engine/core/params.hpp"
#include "engine/linalg/sdp.hpp"
#include "engine/scenario/scenario.hpp"
#include "engine/world/plant.hpp"

namespace vigil {

struct DesignTask {
  std::string lane;
  std::string key;  ///< 16 hexadecimal digits of everything that the answer depends on: equal keys, equal problems
  /// The record that a run takes: at least {"key","holds","reason","solver","objective","gamma_d","gamma_w",
  /// "lambda_max_sigma","lambda_min_p","max_real_pole","norm_l","margins","poles","L","P","iterations","seconds"}.
  /// limit: seconds. Never throws for what a solver does.
  std::function<Json(SdpSolver& solver, double limit)> solve;
  std::function<SdpProblem()> problem;  ///< for people who cross-check with a solver of their own
  /// Throws InputError (pointer "") where a record is of another problem, has no gains of the right sizes, or its
  /// certificate does not hold when it is computed anew (gains that are given run without one).
  std::function<void(const Json& record)> check;
};

/// Of the enabled lanes that need one, in the document's order; empty for most scenarios. Throws InputError where the
/// scenario's plant, or a lane's settings, cannot be designed for.
std::vector<DesignTask> design_tasks(const Scenario& scenario);

/// task.check with the pointer /lanes/<lane>.
void check_design(const DesignTask& task, const Json& record);

/// What a method that needs gains registers beside itself, under the same id. Throws InputError relative to params.
using DesignMake = DesignTask (*)(const Params& params, const Plant& plant);

}  // namespace vigil
