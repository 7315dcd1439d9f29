/// Thresholds learned from recorded rows: where no law can be trusted, what was seen is.
#pragma once

#include <memory>

#include "engine/run/trace.hpp"
#include "engine/scenario/scenario.hpp"

namespace vigil::identify {

/// Runs the scenario on the trace and sets the threshold of every detector `cusum`, and of every detector `fixed` of a
/// lane with one output, to what its statistic exceeds in `rate` of the ticks that are not labelled as attacked (from
/// tick 50 on; over all outputs of the lane). Others keep what they have. Throws InputError as Run does.
Scenario calibrated(const Scenario& scenario, const std::shared_ptr<const Trace>& trace, double rate);

}  // namespace vigil::identify
