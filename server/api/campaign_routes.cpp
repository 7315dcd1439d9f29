// Campaigns: start, look at, pause, end.
#include <algorithm>

#include "engine/core/describe.hpp"
#include "server/api/campaign_json.hpp"
#include "server/api/doc.hpp"
#include "server/api/guard.hpp"
#include "server/api/read_body.hpp"
#include "server/campaigns/manager.hpp"

namespace vigil {
namespace {

const Json kCampaign{{"type", "object"}};

void read_sweep(const Json& sweep, CampaignRequest& request) {
  if (!sweep.is_object())
    throw InputError("/sweep", "sweep is " + shown(sweep) + "; expected {\"path\":[values]}", "object of lists");
  for (const auto& [path, values] : sweep.items()) {
    if (!values.is_array() || values.empty())
      throw InputError("/sweep", path + " is " + shown(values) + "; expected a list of values", "a list of values");
    request.sweep.emplace_back(path, values.get<std::vector<Json>>());
  }
}

void read_input(const Json& input, const Services& services, CampaignRequest& request) {
  if (input == "simulate") return;
  if (!input.is_object() || input.size() != 1 || !input.contains("trace")) {
    throw InputError("/input", "input is " + shown(input) + "; expected \"simulate\" or {\"trace\":id}",
                     "\"simulate\", {\"trace\":id}");
  }
  request.trace = read_id(input.at("trace"), "/input/trace");
  if (services.reader.trace(*request.trace)) return;
  throw InputError("/input/trace", "there is no trace " + std::to_string(*request.trace), "an id of GET /traces");
}

void read_crew(const Json& crew, const Services& services, CampaignRequest& request) {
  if (crew != "threads" && crew != "workers")
    throw InputError("/crew", "crew is " + shown(crew) + "; expected threads or workers", "threads, workers");
  request.workers = crew == "workers";
  if (request.workers && services.broker == nullptr)
    throw InputError("/crew", "this server has no broker that workers could be found by; start it with --nats URL",
                     "threads");
}

CampaignRequest read_request(const Json& body, const Services& services) {
  check_members(body, {"scenario", "patch", "runs", "first_seed", "sweep", "threads", "crew", "samples", "input",
                       "tags", "note"});
  CampaignRequest request;
  request.scenario = read_scenario(body, services);
  if (!body.contains("runs"))
    throw InputError("/runs", "runs is missing; expected how many runs each point has", "1 on");
  request.runs = read_integer(body.at("runs"), "runs", 1, kMostTrials);
  const auto last = static_cast<std::int64_t>(kLargestSeed) - kMostTrials;
  if (body.contains("first_seed"))
    request.first_seed = static_cast<std::uint64_t>(read_integer(body.at("first_seed"), "first_seed", 0, last));
  if (body.contains("sweep")) read_sweep(body.at("sweep"), request);
  if (body.contains("threads")) request.threads = static_cast<int>(read_integer(body.at("threads"), "threads", 1, 256));
  if (body.contains("crew")) read_crew(body.at("crew"), services, request);
  if (body.contains("samples")) {
    if (!body.at("samples").is_boolean())
      throw InputError("/samples", "samples is " + shown(body.at("samples")) + "; expected true or false",
                       "true, false");
    request.samples = body.at("samples").get<bool>();
  }
  if (request.workers && request.samples)
    throw InputError("/crew", "samples are kept by this server's own threads only", "threads");
  if (body.contains("input")) read_input(body.at("input"), services, request);
  if (body.contains("tags")) request.tags = read_tags(body.at("tags"));
  if (body.contains("note")) request.note = read_note(body.at("note"));
  return request;
}

void create(Services& services, const HttpRequest& request, HttpResponse& response) {
  RunOrder key;
  read_idempotency(request, key);
  const CreatedCampaign created =
      services.campaigns.create(read_request(request.json(), services), key.idempotency_key, key.idempotency_hash);
  const auto row = services.reader.campaign(created.id);
  if (!row) throw HttpError(404, "The campaign that this Idempotency-Key made was deleted.");
  response.json(campaign_item(*row, services), 202);
  response.set_header("Location", "/api/v1/campaigns/" + std::to_string(created.id));
  if (!created.fresh) response.set_header("Idempotency-Replayed", "true");
}

void list(const Services& services, const HttpRequest& request, HttpResponse& response) {
  const auto limit = static_cast<std::size_t>(request.query_int("limit", 50, 1, 500));
  const std::int64_t before = request.query_int("cursor", INT64_MAX, 1, INT64_MAX);
  Json answer{{"items", Json::array()}, {"next", nullptr}};
  for (const CampaignRow& row : services.reader.campaigns()) {
    if (row.id >= before) continue;
    if (answer["items"].size() == limit) {
      answer["next"] = answer["items"].back().at("id");
      break;
    }
    answer["items"].push_back(campaign_item(row, services));
  }
  response.json(answer);
}

bool read_flag(const HttpRequest& request, const char* name) {
  const std::string text = request.query_value(name, "true");
  if (text != "true" && text != "false")
    throw HttpError(400, std::string(name) + " is " + in_quotes(text) + "; expected true or false.");
  return text == "true";
}

void show(const Services& services, CampaignResults& results, const HttpRequest& request, HttpResponse& response) {
  const CampaignRow row = campaign_row(request, services);
  if (!read_flag(request, "results")) return response.json(campaign_outline(row, results, services));
  const auto cells = campaign_cells(row, results, services);
  if (request.accepts("text/csv")) return response.text(results_csv(cells), "text/csv; charset=utf-8");
  response.json(campaign_detail(row, cells, services));
}

void cell(const Services& services, CampaignResults& results, const HttpRequest& request, HttpResponse& response) {
  const CampaignRow row = campaign_row(request, services);
  const std::int64_t place = request.id_param("cell");
  const auto found = services.reader.campaign_cell(row.id, place);
  if (!found) throw HttpError(404, "The campaign has no cell " + request.params.at("cell") + ".");
  Json answer{{"cell", place}, {"sweep", found->sweep}};
  answer["result"] = results.result(row, place);
  response.json(answer);
}

void change(Services& services, const HttpRequest& request, HttpResponse& response) {
  const Json body = request.json();
  check_members(body, {"state", "tags", "note"});
  Json words = Json::object();
  if (body.contains("tags")) words["tags"] = read_tags(body.at("tags"));
  if (body.contains("note")) words["note"] = read_note(body.at("note"));
  const CampaignRow row = campaign_row(request, services);
  if (body.contains("state")) {
    const Json& state = body.at("state");
    if (state != "paused" && state != "running" && state != "cancelled") {
      throw InputError("/state", "state is " + shown(state) + "; expected paused, running or cancelled",
                       "paused, running, cancelled");
    }
    services.campaigns.set_state(row.id, state.get<std::string>());
  }
  if (!words.empty()) services.log.describe_campaign(row.id, words);
  response.json(campaign_item(campaign_row(request, services), services));
}

Json create_doc() {
  const Json scenario{{"oneOf", {{{"type", "string"}}, {{"type", "object"}}}},
                      {"description", "an id or a whole document"}};
  const Json values{{"type", "array"}, {"minItems", 1}, {"items", Json::object()}};
  return doc::Operation()
      .parameter(doc::header("Idempotency-Key", "the same key with the same body starts no second campaign"))
      .body(doc::object_schema(
          {{"scenario", scenario},
           {"patch", {{"type", "object"}, {"description", "JSON Merge Patch of the document"}}},
           {"runs", doc::integer_schema(1, kMostTrials)},
           {"first_seed", doc::integer_schema(0, static_cast<std::int64_t>(kLargestSeed) - kMostTrials)},
           {"sweep", {{"type", "object"}, {"additionalProperties", values}}},
           {"threads", doc::integer_schema(1, 256)},
           {"crew", {{"enum", {"threads", "workers"}}, {"description", "who makes the trials; threads without"}}},
           {"samples", {{"type", "boolean"}, {"description", "keep every trial as a run, tagged campaign:ID"}}},
           {"input", {{"description", "\"simulate\" or {\"trace\":id}"}}},
           {"tags", {{"type", "array"}, {"items", {{"type", "string"}}}}},
           {"note", {{"type", "string"}, {"maxLength", 4000}}}},
          {"scenario", "runs"}))
      .answer(202, "The campaign; Location holds its address.", kCampaign)
      .problem(422, "The scenario, the sweep, or what was asked beside them is not valid.")
      .problem(503, "Too many campaigns wait already.")
      .what();
}

Json change_doc() {
  return doc::Operation()
      .body(doc::object_schema({{"state", {{"enum", {"paused", "running", "cancelled"}}}},
                                {"tags", {{"type", "array"}, {"items", {{"type", "string"}}}}},
                                {"note", {{"type", "string"}, {"maxLength", 4000}}}}))
      .answer(200, "The campaign as it is now.", kCampaign)
      .problem(404, "There is no such campaign.")
      .problem(409, "It is over.")
      .what();
}

/// Routes of one campaign.
void add_single_routes(Routes& routes, Services& services, const SharedResults& results) {
  const auto one = [] { return doc::Operation().problem(404, "There is no such campaign."); };
  routes.add(make_route(
      "GET", "/api/v1/campaigns/{id}", [&services, results](const auto& q, auto& r) { show(services, *results, q, r); },
      "A campaign: request, state, progress, cells, results; as CSV the results",
      one()
          .parameter(doc::query("results", {{"type", "boolean"}},
                                "false: which metrics there are instead of their figures, and no faults"))
          .answer(200, "The campaign.", kCampaign)
          .answer(200, "The campaign.", doc::text_schema(), "text/csv")
          .what()));
  routes.add(make_route(
      "GET", "/api/v1/campaigns/{id}/cells/{cell}",
      [&services, results](const auto& q, auto& r) { cell(services, *results, q, r); },
      "A point of the grid with everything that is said of it: metrics, paired differences, detection curves",
      one().answer(200, "The cell; `result` is null before its first trial.", kCampaign).what()));
  routes.add(make_route(
      "PATCH", "/api/v1/campaigns/{id}", [&services](const auto& q, auto& r) { change(services, q, r); },
      "Pause, go on with or cancel a campaign; its tags and note", change_doc()));
  routes.add(make_route(
      "DELETE", "/api/v1/campaigns/{id}",
      [&services](const auto& q, auto& r) {
        services.campaigns.remove(campaign_row(q, services).id);
        r.empty();
      },
      "Delete a campaign with its trials; runs that keep samples stay", one().empty(204, "It is gone.").what()));
}

}  // namespace

void add_campaign_routes(Routes& routes, Services& services) {
  routes.add(make_route(
      "POST", "/api/v1/campaigns", [&services](const auto& q, auto& r) { create(services, q, r); }, "Start a campaign",
      create_doc()));
  routes.add(make_route(
      "GET", "/api/v1/campaigns", [&services](const auto& q, auto& r) { list(services, q, r); },
      "Campaigns, newest first",
      doc::Operation()
          .parameter(doc::query("limit", doc::integer_schema(1, 500), "items a page, 50 without"))
          .parameter(doc::query("cursor", doc::text_schema(), "`next` of the page before"))
          .answer(200, "A page of campaigns.", doc::page_schema(kCampaign))
          .what()));
  const auto results = std::make_shared<CampaignResults>(services.reader);
  add_single_routes(routes, services, results);
  add_result_routes(routes, services, results);
  add_trial_routes(routes, services);
}

}  // namespace vigil
