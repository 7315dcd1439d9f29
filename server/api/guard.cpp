#include "server/api/guard.hpp"

#include <utility>

#include "db/query.hpp"
#include "db/records.hpp"
#include "server/runs/refusal.hpp"

namespace vigil {
namespace {

[[noreturn]] void rethrow(const LogError& error) {
  switch (error.kind()) {
    case LogError::Kind::missing:
      throw HttpError(404, error.what());
    case LogError::Kind::conflict:
      throw HttpError(422, error.what(), {{"", error.what(), "the same body, or another Idempotency-Key"}});
    case LogError::Kind::disk:
    case LogError::Kind::unusable:
      break;
  }
  throw HttpError(503, error.what()).with_header("Retry-After", "5");
}

[[noreturn]] void rethrow(const RunRefusal& refusal) {
  if (refusal.kind() == RunRefusal::Kind::state) throw HttpError(409, refusal.what());
  if (refusal.kind() == RunRefusal::Kind::behind) throw HttpError(429, refusal.what()).with_header("Retry-After", "1");
  throw HttpError(503, refusal.what()).with_header("Retry-After", "2");
}

}  // namespace

Handler guarded(Handler handler) {
  return [handler = std::move(handler)](const HttpRequest& request, HttpResponse& response) {
    try {
      handler(request, response);
    } catch (const LogError& error) {
      rethrow(error);
    } catch (const RunRefusal& refusal) {
      rethrow(refusal);
    } catch (const QueryError& error) {
      throw HttpError(400, error.what(), {{"", "column " + std::to_string(error.column()) + ": " + error.what(), ""}});
    }
  };
}

Route make_route(const char* method, const char* pattern, Handler handler, const char* summary, Json doc) {
  Route route;
  route.method = method;
  route.pattern = pattern;
  route.handler = guarded(std::move(handler));
  route.summary = summary;
  route.doc = std::move(doc);
  return route;
}

}  // namespace vigil
