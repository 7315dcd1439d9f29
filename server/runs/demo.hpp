/// The run that every visitor finds alive.
#pragma once

#include "db/reader.hpp"
#include "db/writer.hpp"
#include "server/runs/manager.hpp"

namespace vigil {

/// Starts a demo run (preset `consensus`, endless, 20 ticks a second, samples kept ten minutes) and removes those of
/// earlier servers except the newest. Runs a user has tagged "keep" stay. Throws what RunManager::create does.
RunId start_demo(RunManager& runs, LogWriter& log, const LogReader& reader);

}  // namespace vigil
