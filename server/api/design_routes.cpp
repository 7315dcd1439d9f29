// Gains before there is a run: ask for them, look at them, take their problem elsewhere.
#include "engine/core/describe.hpp"
#include "server/api/doc.hpp"
#include "server/api/guard.hpp"
#include "server/api/read_body.hpp"
#include "server/synthesis/designer.hpp"

namespace vigil {
namespace {

void ask(Services& services, const HttpRequest& request, HttpResponse& response) {
  const Json body = request.json();
  check_members(body, {"scenario", "patch"});
  const std::vector<DesignTask> tasks = design_tasks(read_scenario(body, services));
  Json answer{{"items", Json::array()}};
  for (const DesignItem& item : services.runs.designer().ask(tasks)) answer["items"].push_back(to_json(item));
  response.json(answer, 202);
}

HttpError unknown(const std::string& key) {
  return HttpError(404,
                   "There is no design " + in_quotes(key) + "; POST /api/v1/designs asks for those of a scenario.");
}

void look(Services& services, const HttpRequest& request, HttpResponse& response) {
  const std::string key = request.params.at("key");
  const auto item = services.runs.designer().find(key);
  if (!item) throw unknown(key);
  response.json(to_json(*item));
}

void problem(Services& services, const HttpRequest& request, HttpResponse& response) {
  const std::string key = request.params.at("key");
  const auto text = services.runs.designer().sdpa(key);
  if (!text) throw unknown(key);
  response.text(*text);
  response.set_header("Content-Disposition", "attachment; filename=\"vigil-design.dat-s\"");
}

Json item_schema() {
  const Json seconds{{"type", "number"}, {"minimum", 0}};
  const Json maybe_record{
      {"type", {"object", "null"}},
      {"description", "gains L, P, gamma_d, gamma_w, margins, poles, norms and whether the certificate holds"}};
  return doc::object_schema({{"lane", doc::text_schema("that asked for it")},
                             {"key", doc::text_schema("of the problem: equal keys, equal problems")},
                             {"state", {{"enum", {"queued", "solving", "done", "refused"}}}},
                             {"seconds", seconds},
                             {"limit", seconds},
                             {"record", maybe_record},
                             {"reason", {{"type", {"string", "null"}}}}});
}

Json ask_doc() {
  const Json scenario{{"oneOf", {{{"type", "string"}}, {{"type", "object"}}}},
                      {"description", "an id or a whole document"}};
  const Json items{{"type", "array"}, {"items", item_schema()}};
  return doc::Operation()
      .body(doc::object_schema({{"scenario", scenario},
                                {"patch", {{"type", "object"}, {"description", "JSON Merge Patch of the document"}}}},
                               {"scenario"}))
      .answer(202, "One item a lane that needs gains; none for most scenarios.", doc::object_schema({{"items", items}}))
      .problem(422, "The scenario is not valid, or its system cannot be designed for.")
      .problem(503, "Too many designs wait already.")
      .what();
}

}  // namespace

void add_design_routes(Routes& routes, Services& services) {
  routes.add(make_route(
      "POST", "/api/v1/designs", [&services](const auto& q, auto& r) { ask(services, q, r); },
      "Find the gains that a scenario's lanes need", ask_doc()));
  routes.add(make_route(
      "GET", "/api/v1/designs/{key}", [&services](const auto& q, auto& r) { look(services, q, r); },
      "What has become of a design",
      doc::Operation().answer(200, "The design.", item_schema()).problem(404, "It was never asked for.").what()));
  routes.add(make_route(
      "GET", "/api/v1/designs/{key}/sdpa", [&services](const auto& q, auto& r) { problem(services, q, r); },
      "Its semidefinite program, for a solver of your own",
      doc::Operation()
          .answer(200, "SDPA's sparse format.", doc::text_schema(), "text/plain")
          .problem(404, "It was never asked for.")
          .what()));
}

}  // namespace vigil
