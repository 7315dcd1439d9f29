// Presets and scenarios of the user's own; the registry.
#include <algorithm>

#include "engine/core/describe.hpp"
#include "server/api/doc.hpp"
#include "server/api/guard.hpp"
#include "server/api/read_body.hpp"
#include "server/api/services.hpp"

namespace vigil {
namespace {

const Json kDocument{{"type", "object"}};

Json item_json(const Json& document, bool preset) {
  Json lanes = Json::array();
  for (const auto& [lane, body] : document.at("lanes").items()) lanes.push_back(lane);
  return {{"id", document.at("id")},
          {"title", document.at("title")},
          {"family", document.at("family")},
          {"source", document.at("source")},
          {"preset", preset},
          {"lanes", std::move(lanes)}};
}

void list(const Services& services, HttpResponse& response) {
  Json answer{{"items", Json::array()}, {"next", nullptr}};
  for (const std::string& id : Scenario::preset_ids()) {
    answer["items"].push_back(item_json(Scenario::preset(id).document(), true));
  }
  for (const ScenarioRow& row : services.reader.scenarios()) {
    Json item = item_json(row.document, false);
    item["created"] = to_rfc3339(row.created);
    item["updated"] = to_rfc3339(row.updated);
    answer["items"].push_back(std::move(item));
  }
  response.json(answer);
}

bool is_scenario_id(const std::string& id) {
  const auto fits = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '_'; };
  return !id.empty() && id.size() <= 64 && std::all_of(id.begin(), id.end(), fits);
}

void store(Services& services, const HttpRequest& request, HttpResponse& response) {
  const std::string id = request.params.at("id");
  if (Scenario::is_preset(id))
    throw HttpError(409, in_quotes(id) + " is a preset and cannot be changed; store yours under another id.");
  if (!is_scenario_id(id)) {
    throw HttpError(400, "The id is " + in_quotes(id) + "; expected 1 to 64 of a-z, 0-9, - and _.");
  }
  Json document = request.json();
  document["id"] = id;
  const Scenario scenario = Scenario::from_json(document);
  const bool known = services.reader.scenario(id).has_value();
  services.log.put_scenario(id, scenario.document());
  response.json(scenario.document(), known ? 200 : 201);
  if (!known) response.set_header("Location", "/api/v1/scenarios/" + id);
}

void remove(Services& services, const HttpRequest& request, HttpResponse& response) {
  const std::string id = request.params.at("id");
  if (Scenario::is_preset(id)) throw HttpError(409, in_quotes(id) + " is a preset and cannot be deleted.");
  if (!services.log.delete_scenario(id)) throw HttpError(404, "There is no scenario " + in_quotes(id) + ".");
  response.empty();
}

}  // namespace

void add_scenario_routes(Routes& routes, Services& services) {
  routes.add(make_route(
      "GET", "/api/v1/scenarios", [&services](const auto&, auto& r) { list(services, r); },
      "Presets and the user's own scenarios",
      doc::Operation().answer(200, "Every scenario.", doc::page_schema(kDocument)).what()));
  routes.add(make_route(
      "GET", "/api/v1/scenarios/{id}",
      [&services](const auto& q, auto& r) { r.json(named_scenario(services, q.params.at("id")).document()); },
      "A scenario's whole document",
      doc::Operation().answer(200, "The document.", kDocument).problem(404, "There is no such scenario.").what()));
  routes.add(make_route(
      "GET", "/api/v1/scenarios/{id}/schema",
      [&services](const auto& q, auto& r) { r.json(named_scenario(services, q.params.at("id")).schema()); },
      "JSON Schema of documents like this one",
      doc::Operation().answer(200, "The schema.", kDocument).problem(404, "There is no such scenario.").what()));
  routes.add(make_route(
      "PUT", "/api/v1/scenarios/{id}", [&services](const auto& q, auto& r) { store(services, q, r); },
      "Store a scenario of the user's own",
      doc::Operation()
          .body(kDocument)
          .answer(200, "It was replaced; the document with its defaults.", kDocument)
          .answer(201, "It is new; the document with its defaults.", kDocument)
          .problem(409, "The id is a preset's.")
          .problem(422, "The document is not valid.")
          .what()));
  routes.add(make_route(
      "DELETE", "/api/v1/scenarios/{id}", [&services](const auto& q, auto& r) { remove(services, q, r); },
      "Delete a scenario of the user's own",
      doc::Operation()
          .empty(204, "It is gone.")
          .problem(404, "There is no such scenario.")
          .problem(409, "It is a preset.")
          .what()));
  routes.add(make_route(
      "GET", "/api/v1/methods", [](const auto&, auto& r) { r.json(registry_json()); },
      "Every method, attack, plant, sensor and law with its declared parameters",
      doc::Operation().answer(200, "The registry.", kDocument).what()));
}

}  // namespace vigil
