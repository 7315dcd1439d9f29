/// Which lane of a scenario meets which attack on which kind of channel, and why not where not.
#pragma once

#include <string>

#include "engine/core/json.hpp"
#include "engine/scenario/scenario.hpp"

namespace vigil {

/// {"lanes":[{"id","method"}],
///  "rows":[{"attack","title":{"en","zh"},"channel":"link"|"sensor"|"actuator","place":"link:*","params":{…},
///           "reason":null or why nobody meets it, "cells":{"<lane>":{"meets":…,"reason":…}}}]}
/// `place` and `params` are an example that is accepted there. "meets" is what the attack reaches first of the lane:
/// "estimate", "detector" (path monitor), "plant", "messages" (it is overheard), or null with the reason beside it.
/// Every attack of the registry has a row for each of the three channels. Throws InputError where the scenario cannot
/// be run without a trace, or at all.
Json compatibility(const Scenario& scenario);

/// docs/compatibility.md: the tables of the presets.
std::string compatibility_markdown();

}  // namespace vigil
