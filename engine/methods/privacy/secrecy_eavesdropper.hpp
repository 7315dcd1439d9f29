/// Those who undo a state-secrecy code as far as it can be undone: they know the code, but not what the user got.
/// Specification (privacy), section 4.6.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "engine/methods/privacy/protection.hpp"
#include "engine/methods/privacy/secrecy_code.hpp"

namespace vigil::privacy {

/// Code A: decodes each sensor's messages recursively from the prior, xe <- z + A xe, or A xe where it missed one, and
/// fuses with the nominal weights. Takes it that the user got every message.
std::unique_ptr<Eavesdropper> code_a_listener(const FusionModel& model);

/// Code L: decodes a sensor's messages, with its Lc, until it misses one. What comes after that is worth nothing, so
/// that it fuses those of whom it has missed none, and where there is none keeps to the prior mean. `recent`: the code
/// leaks, and it then takes the best linear estimate from the last messages.
std::unique_ptr<Eavesdropper> code_l_listener(const FusionModel& model, const std::vector<Eigen::MatrixXd>& Lc,
                                              std::optional<RecentMessages> recent);

}  // namespace vigil::privacy
