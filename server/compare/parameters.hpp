/// What differs between the documents of runs.
#pragma once

#include "server/compare/compared_run.hpp"

namespace vigil {

/// [{"path":"lanes.consensus.params.tau","values":[…]}]: one entry a path that differs, its values in the order of the
/// runs, null where a document has no such member. Lists are compared whole. What a run took while it ran stands at
/// `commands.<k>.<n>`, what it ran on at `input`. Runs without a document have null everywhere and count for nothing.
Json differing_parameters(const std::vector<ComparedRun>& runs);

}  // namespace vigil
