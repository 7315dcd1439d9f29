// Which lane of a scenario meets which attack.
#include "engine/run/compatibility.hpp"
#include "server/api/doc.hpp"
#include "server/api/guard.hpp"
#include "server/api/openapi.hpp"
#include "server/api/read_body.hpp"

namespace vigil {
namespace {

void ask(Services& services, const Json& body, HttpResponse& response) {
  check_members(body, {"scenario", "patch"});
  const Scenario scenario = read_scenario(body, services);
  try {
    response.json(compatibility(scenario));
  } catch (const InputError& error) {
    rethrow_below(error, "/scenario");
  }
}

doc::Operation operation() {
  const Json objects{{"type", "array"}, {"items", {{"type", "object"}}}};
  return doc::Operation()
      .answer(200, "A row for every attack and channel, a cell for every lane, with reasons.",
              doc::object_schema({{"lanes", objects}, {"rows", objects}}))
      .problem(422, "The scenario is not valid, or needs a trace.");
}

}  // namespace

void add_compatibility_routes(Routes& routes, Services& services) {
  const Json scenario{{"oneOf", {{{"type", "string"}}, {{"type", "object"}}}},
                      {"description", "an id or a whole document"}};
  const Json patch{{"type", "object"}, {"description", "JSON Merge Patch of the document"}};
  routes.add(make_route(
      "GET", "/api/v1/scenarios/{id}/compatibility",
      [&services](const auto& q, auto& r) { r.json(compatibility(named_scenario(services, q.params.at("id")))); },
      "Which lane meets which attack on which channel, and why not where not",
      operation().problem(404, "There is no such scenario.").what()));
  routes.add(make_route(
      "POST", "/api/v1/compatibility", [&services](const auto& q, auto& r) { ask(services, q.json(), r); },
      "The same of a document that need not be stored",
      operation().body(doc::object_schema({{"scenario", scenario}, {"patch", patch}}, {"scenario"})).what()));
}

}  // namespace vigil
