/// The papers, run again, over HTTP.
#pragma once

#include "server/front/front.hpp"
#include "server/papers/manager.hpp"

namespace vigil {

/// `papers` outlives the table.
void add_papers_routes(Routes& routes, PapersManager& papers);

}  // namespace vigil
