/// The scenarios that come with Vigil, as documents that still lack their defaults.
#pragma once

#include "engine/core/json.hpp"

namespace vigil::presets {

/// Seed 000 in centimetres and degrees: specification, sections 2, 3 and 11, column cmdeg.
Json consensus();
/// The same with a compass on every camera: the theorem's conditions hold at every step.
Json consensus_compass();
/// The paper's numbers read as metres and radians: expected to fail to track.
Json consensus_literal();
/// A real robot and fifteen landmarks: UTIAS MRCLAM data set 6, robot 3. Needs a trace.
Json mrclam();
/// Seed 001: five ground stations, one target in space, false data on range and azimuth; all nine lanes.
Json sparse();
/// Seed 003: two tanks under control, their output recorded and played back; noise with outliers, bounded noise, both.
Json replay_nongaussian();
Json replay_ubb();
Json replay_mixed();
/// Seed 002: example 3.1, comparison 1 (four areas) and comparison 2 (subsystem 2 alone), in continuous time.
Json observer_pair();
Json observer_areas();
Json observer_single();
/// Seed 004: contamination on a linear and a nonlinear robot, differential privacy on a turning target, and an engine
/// with two noises in a row, contamination and both secrecy codes.
Json privacy_robot_linear();
Json privacy_robot_nonlinear();
Json privacy_turn();
Json privacy_engine();

}  // namespace vigil::presets
