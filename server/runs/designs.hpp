/// Gains that a run needs before it can be made, and those that it brings along.
#pragma once

#include <vector>

#include "engine/run/design.hpp"
#include "server/runs/order.hpp"
#include "server/synthesis/design_item.hpp"

namespace vigil {

/// Keeps those of the order's records that answer a task of its scenario, whichever lane they were found for, and
/// returns the tasks that are left. Throws InputError where the scenario cannot be designed for.
std::vector<DesignTask> open_tasks(RunOrder& order);

/// Throws InputError with the reason where a run cannot have what has become of its task.
void require_gains(const DesignTask& task, const DesignItem& item);

/// Records from outside: those that answer a task of the scenario are computed anew. Throws InputError with pointers
/// below /designs.
void check_designs(const Scenario& scenario, const Json& designs);

}  // namespace vigil
