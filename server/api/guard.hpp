/// Turns what the rooms behind the routes throw into answers.
#pragma once

#include "server/front/route.hpp"

namespace vigil {

/// LogError, QueryError and RunRefusal become HttpError with the fitting status; all else passes through.
Handler guarded(Handler handler);
/// A route with a guarded handler; a GET takes no body.
Route make_route(const char* method, const char* pattern, Handler handler, const char* summary, Json doc);

}  // namespace vigil
