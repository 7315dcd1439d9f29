/// Sentences about modes and who sees them.
#pragma once

#include <string>
#include <vector>

#include "engine/linalg/modes.hpp"
#include "engine/run/course.hpp"

namespace vigil {

/// "1.05 ± 0.3i": six significant digits.
std::string mode_text(const Mode& mode);
/// "decays", "stays", "grows"
std::string_view to_string(Fate fate);
/// "the mode 1.05 ± 0.3i, which grows", or several of them; the largest first, at most four by name.
std::string modes_text(const std::vector<Mode>& modes, const Modes& all);
/// Every one of them decays.
bool all_decay(const std::vector<Mode>& modes, const Modes& all);

/// What whoever starts a run must know of its world: an unstable closed loop; inputs that nobody gives; a mode of a
/// linear plant in ticks that does not decay and that no node sees. traced: a trace takes the place of the world.
std::vector<std::string> world_warnings(const World& world, bool traced);

}  // namespace vigil
