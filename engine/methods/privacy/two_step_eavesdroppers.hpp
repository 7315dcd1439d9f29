/// Those who undo the sums of the two-step mechanism, knowing the window but no noise. Specification (privacy),
/// sections 4.3 and 4.4.
#pragma once

#include <memory>

#include "engine/methods/privacy/model.hpp"
#include "engine/methods/privacy/protection.hpp"

namespace vigil::privacy {

/// Takes each sensor's differences, as the legitimate user does, and fuses with the nominal weights. For a sensor whose
/// message it missed it moves what it has with A, in that tick and in the next, whose difference it cannot make; what
/// is then amiss stays in all sums that go on from there.
std::unique_ptr<Eavesdropper> differencing_eavesdropper(const FusionModel& model, int window);

/// Takes each message, divided by the window's length, for the estimate; moves the one of a sensor it missed with A.
std::unique_ptr<Eavesdropper> window_mean_eavesdropper(const FusionModel& model, int window);

}  // namespace vigil::privacy
