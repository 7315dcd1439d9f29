/// What a lane of observers is asked for: its plant with the lane's own tuning, and where its gains come from.
#pragma once

#include "engine/core/params.hpp"
#include "engine/methods/observer/design.hpp"
#include "engine/run/design.hpp"
#include "engine/world/plant.hpp"

namespace vigil::observer {

enum class Source { design, printed, given, riccati };

struct Settings {
  Network network;  ///< kappa, mu and varsigma as the lane says
  ErrorSystem system;
  Source source = Source::design;
  SynthesisOptions options;
  RiccatiWeights weights;
  Gains gains;  ///< of sources printed and given
};

ParamTable intermediate_params();
ParamTable matched_params();
/// Throw InputError, relative to the params, where the plant is not made of subsystems or a setting does not fit it.
Settings intermediate_settings(const Params& params, const Plant& plant);
Settings matched_settings(const Params& params, const Plant& plant);

/// What is to be solved for them: synthesis, the certificate of gains at hand, or the Riccati fallback.
DesignTask task_of(const Settings& settings);

/// The gains that a lane runs with. Throws InputError (pointer "") where the record is none of this task's, or is not
/// accepted.
Gains accepted_gains(const Settings& settings, const Json& record);

}  // namespace vigil::observer
