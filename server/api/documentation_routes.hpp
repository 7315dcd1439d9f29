/// The methods' documentation over HTTP, so that the page shows it without the repository.
#pragma once

#include "server/front/route.hpp"

namespace vigil {

void add_documentation_routes(Routes& routes);

}  // namespace vigil
