/// What is kept of an item that was run: as the log holds it, and back.
#pragma once

#include "engine/papers/item.hpp"

namespace vigil::papers {

/// What an item says before it was ever run: the members of to_json() that do not depend on runs, with "rule" and what
/// it stands on but for its equations; the rest null.
Json described(const Item& item);
/// The same with what a kept result says, but for its figure.
Json described(const Item& item, const Json& kept);
/// The same with its equations and its figure, null where it was never run.
Json detailed(const Item& item, const Json& kept);
/// Out of to_json(item, findings). A bound that is null is infinite, any other missing number NaN.
Findings findings_of(const Json& json);

}  // namespace vigil::papers
