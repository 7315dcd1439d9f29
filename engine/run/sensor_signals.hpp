/// The signals of sensors: state, and for every channel what arrived, what was sent where that differs, what was
/// injected and the tick that was played back. The world has them, and every lane with readings of its own.
#pragma once

#include <string>
#include <vector>

#include "engine/run/course.hpp"
#include "engine/run/frame.hpp"

namespace vigil {

/// Declares "<prefix>sensor.<node>.…" of every node, one after the other; returns the id of the first.
int declare_sensors(const std::string& prefix, const std::string& lane, const std::vector<std::string>& nodes,
                    const World& world, Catalogue& catalogue);

/// Writes them to where the first stands.
void publish_sensors(const Course& course, const SensorEffects& effects, double* first);

}  // namespace vigil
