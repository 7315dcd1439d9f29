/// What can be said of a scenario's plant, sensors, noise and network before anything runs, and which methods fit them.
#pragma once

#include "engine/core/json.hpp"
#include "engine/scenario/scenario.hpp"

namespace vigil {

/// The report of `vigil check` and POST /systems/check; its members stand in docs/api.md. Linear plants are judged
/// as they are, others linearised at their initial truth, which the report says. Throws InputError where the world
/// cannot be made (matrices of wrong sizes, a sensor that needs a trace); a lane that does not fit is part of the
/// report.
Json system_report(const Scenario& scenario);

}  // namespace vigil
