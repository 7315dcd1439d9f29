// What a system is, before there is a run.
#include "engine/run/system_report.hpp"
#include "server/api/doc.hpp"
#include "server/api/guard.hpp"
#include "server/api/read_body.hpp"

namespace vigil {
namespace {

void check(Services& services, const HttpRequest& request, HttpResponse& response) {
  const Json body = request.json();
  check_members(body, {"scenario", "patch"});
  const Scenario scenario = read_scenario(body, services);
  try {
    response.json(system_report(scenario));
  } catch (const InputError& error) {
    rethrow_below(error, "/scenario");
  }
}

Json answer_schema() {
  const Json object{{"type", "object"}}, maybe{{"type", {"object", "null"}}};
  const Json objects{{"type", "array"}, {"items", object}};
  return doc::object_schema({{"scenario", doc::text_schema("its id")},
                             {"tolerance", doc::text_schema("when a mode counts as hidden")},
                             {"plant", object},
                             {"nodes", objects},
                             {"joint", object},
                             {"control", maybe},
                             {"controller", maybe},
                             {"noise", object},
                             {"graph", object},
                             {"methods", objects},
                             {"run", object},
                             {"verdicts", objects}});
}

Json check_doc() {
  const Json scenario{{"oneOf", {{{"type", "string"}}, {{"type", "object"}}}},
                      {"description", "an id or a whole document"}};
  return doc::Operation()
      .body(doc::object_schema({{"scenario", scenario},
                                {"patch", {{"type", "object"}, {"description", "JSON Merge Patch of the document"}}}},
                               {"scenario"}))
      .answer(200, "Poles, who sees which mode, definiteness, connectivity, and every method with why not.",
              answer_schema())
      .problem(422, "The scenario is not valid, or its world cannot be made.")
      .what();
}

}  // namespace

void add_check_routes(Routes& routes, Services& services) {
  routes.add(make_route(
      "POST", "/api/v1/systems/check", [&services](const auto& q, auto& r) { check(services, q, r); },
      "Say what a scenario's system is and which methods fit it", check_doc()));
}

}  // namespace vigil
