/// Which methods would run on a scenario, and whether it would itself.
#pragma once

#include "engine/core/json.hpp"
#include "engine/scenario/scenario.hpp"

namespace vigil {

/// [{"id","title","fits","reason","pointer","needs_gains"}]: every registered method, alone with its default parameters
/// in a lane "check" and with no attack; reason: the sentence of the refusal, null where there is none.
Json method_fits(const Scenario& scenario);
/// {"starts","reason","pointer","warnings"}: the scenario as it stands, its lanes and attacks included. Where gains
/// have to be found first the run itself is not tried.
Json run_fit(const Scenario& scenario);

}  // namespace vigil
