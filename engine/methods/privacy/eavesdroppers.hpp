/// Those who overhear the messages to a fusion centre and take them for local estimates. Specification (privacy),
/// sections 2.1, 2.8 and 4.4.
#pragma once

#include <memory>

#include "engine/methods/privacy/protection.hpp"

namespace vigil::privacy {

/// Keeps the newest message of every sensor, moves the one of a sensor it did not hear with the plant's public model,
/// and fuses with the nominal weights. Starts from the prior.
std::unique_ptr<Eavesdropper> fusing_eavesdropper(const Knowledge& knowledge);

/// Believes that the state is zero, whatever it hears; of `states` components.
std::unique_ptr<Eavesdropper> zero_eavesdropper(int states);

}  // namespace vigil::privacy
