/// The API's description, made from the table that routes.
#pragma once

#include "server/front/route.hpp"

namespace vigil {

/// OpenAPI 3.1 with every route of the table: path parameters, bodies, the problems each may answer.
Json openapi_json(const Routes& routes);

}  // namespace vigil
