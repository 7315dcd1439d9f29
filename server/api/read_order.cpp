// The body of POST /runs.
#include <random>

#include "engine/core/describe.hpp"
#include "server/api/read_body.hpp"

namespace vigil {
namespace {

Scenario read_base(const Json& value, const Services& services) {
  if (value.is_string()) {
    const auto id = value.get<std::string>();
    if (Scenario::is_preset(id)) return Scenario::preset(id);
    if (const auto row = services.reader.scenario(id)) return Scenario::from_json(row->document);
    throw InputError("/scenario", "there is no scenario " + in_quotes(id) + "; expected one of GET /api/v1/scenarios",
                     listed(Scenario::preset_ids()) + ", or one of your own");
  }
  if (!value.is_object()) {
    throw InputError("/scenario", "scenario is " + shown(value) + "; expected an id or a document", "text or object");
  }
  try {
    return Scenario::from_json(value);
  } catch (const InputError& error) {
    rethrow_below(error, "/scenario");
  }
}

void read_input(const Json& input, Services& services, RunOrder& order) {
  if (input == "simulate") return;
  if (is_ingest(input)) {
    order.feed = std::make_shared<IngestFeed>(order.scenario, read_ingest(input));
    if (order.feed->plant() && !services.outside->listens())
      throw InputError("/input/ingest/mqtt", "no topics feed this server: it was not started with --mqtt-topic");
    return;
  }
  if (!input.is_object() || input.size() != 1 || !input.contains("trace")) {
    throw InputError("/input", "input is " + shown(input) + "; expected \"simulate\", {\"trace\":id} or \"ingest\"",
                     "\"simulate\", {\"trace\":id}, \"ingest\"");
  }
  order.trace_id = read_id(input.at("trace"), "/input/trace");
  order.trace = services.runs.trace(*order.trace_id);
  if (!order.trace) {
    throw InputError("/input/trace", "there is no trace " + std::to_string(*order.trace_id),
                     "an id of GET /api/v1/traces");
  }
}

/// What is pushed comes from the world: whoever might attack it must not guess what noise and marks are drawn from.
std::uint64_t unguessed_seed() {
  std::random_device source;
  const std::uint64_t high = source(), low = source();
  return ((high << 32) | low) & kLargestSeed;
}

}  // namespace

Scenario read_scenario(const Json& body, const Services& services) {
  if (!body.contains("scenario")) {
    throw InputError("/scenario", "scenario is missing; expected an id or a document", "text or object");
  }
  Scenario scenario = read_base(body.at("scenario"), services);
  const Json patch = body.value("patch", Json::object());
  if (!patch.is_object()) throw InputError("/patch", "patch is " + shown(patch) + "; expected an object", "object");
  if (patch.empty()) return scenario;
  try {
    return scenario.patched(patch);
  } catch (const InputError& error) {
    rethrow_below(error, "/patch");
  }
}

RunOrder read_order(const HttpRequest& request, Services& services) {
  const Json body = request.json();
  check_members(body, {"scenario", "patch", "seed", "pace", "input", "webhook", "tags", "note"});
  RunOrder order;
  order.scenario = read_scenario(body, services);
  if (body.contains("seed")) {
    order.seed =
        static_cast<std::uint64_t>(read_integer(body.at("seed"), "seed", 0, static_cast<std::int64_t>(kLargestSeed)));
  }
  if (body.contains("pace")) order.pace = Pace::from_json(body.at("pace"), "/pace");
  if (body.contains("input")) read_input(body.at("input"), services, order);
  if (order.feed && !body.contains("seed")) order.seed = unguessed_seed();
  if (body.contains("webhook"))
    order.webhook = read_webhook(body.at("webhook"), services.runs.webhooks().options().allow);
  if (body.contains("tags")) order.tags = read_tags(body.at("tags"));
  if (body.contains("note")) order.note = read_note(body.at("note"));
  read_idempotency(request, order);
  return order;
}

}  // namespace vigil
