/// The paper's own gains of example 3.1. Specification (observer), section 8.1.
#pragma once

#include "engine/methods/observer/augment.hpp"

namespace vigil::observer {

/// The gains of the paper: stable and certified, but blind to the attacks; four digits, so never a design to work with.
Gains printed_gains();

}  // namespace vigil::observer
