#include "server/api/documentation_routes.hpp"

#include "engine/core/describe.hpp"
#include "engine/scenario/method_page.hpp"
#include "server/api/doc.hpp"
#include "server/api/guard.hpp"

namespace vigil {
namespace {

const Json kDocument{{"type", "object"}};

void show(const HttpRequest& request, HttpResponse& response) {
  const std::string id = request.params.at("method");
  const Json page = method_page(id);
  if (page.is_null())
    throw HttpError(404, "There is no method " + in_quotes(id) + "; GET /api/v1/documentation has them all.");
  response.json(page);
}

}  // namespace

void add_documentation_routes(Routes& routes) {
  routes.add(make_route(
      "GET", "/api/v1/documentation", [](const auto&, auto& r) { r.json(method_index()); },
      "The methods, protections and detectors that are documented",
      doc::Operation().answer(200, "Id, kind, title, family and a line of each.", kDocument).what()));
  routes.add(make_route(
      "GET", "/api/v1/documentation/{method}", [](const auto& q, auto& r) { show(q, r); },
      "A method with model, equations (MathML), algorithm, parameters, cost and what was corrected",
      doc::Operation().answer(200, "The page as data.", kDocument).problem(404, "There is no such method.").what()));
}

}  // namespace vigil
