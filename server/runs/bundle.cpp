#include "server/runs/bundle.hpp"

#include <algorithm>

#include "engine/core/describe.hpp"
#include "engine/run/trace.hpp"
#include "server/runs/designs.hpp"

namespace vigil {
namespace {

const Json& required(const Json& json, const char* key, bool fits, const char* expected) {
  const auto place = json.find(key);
  static const Json null;
  if (fits) return *place;
  throw InputError(child("", key),
                   std::string(key) + " is " + shown(place == json.end() ? null : *place) + "; expected " + expected,
                   expected);
}

bool holds(const Json& json, const char* key, bool (Json::*kind)() const noexcept) {
  const auto place = json.find(key);
  return place != json.end() && ((*place).*kind)();
}

/// Problems of the document, under /document.
Scenario read_document(const Json& document) {
  try {
    return Scenario::from_json(document);
  } catch (const InputError& error) {
    std::vector<Problem> problems = error.problems();
    for (Problem& problem : problems) problem.pointer = "/document" + problem.pointer;
    throw InputError(std::move(problems));
  }
}

std::vector<Command> read_commands(const Json& list) {
  std::vector<Command> commands;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Json& item = list[i];
    if (!item.is_object() || !holds(item, "k", &Json::is_number_unsigned) || !holds(item, "body", &Json::is_object)) {
      throw InputError(child("/commands", i), "the command is " + shown(item) + "; expected {\"k\":tick,\"body\":{…}}",
                       "k and body");
    }
    commands.push_back({item.at("k").get<std::int64_t>(), item.at("body")});
  }
  return commands;
}

/// A run that has had every earlier command is what each is checked against. Where gains must be found first there is
/// none yet: what does not fit is said when it is made.
void check_commands(const RunOrder& order) {
  RunOrder bare = order;
  bare.commands.clear();
  if (!open_tasks(bare).empty()) return;
  Run scratch = make_run(bare);
  for (std::size_t i = 0; i < order.commands.size(); ++i) {
    const Command& command = order.commands[i];
    if (i > 0 && command.k < order.commands[i - 1].k)
      throw InputError(child("/commands", i), "the commands are not in the order of their ticks", "rising k");
    try {
      scratch.prepare(command.body, command.k);
      scratch.apply(command);  // so that the next one is checked with it
    } catch (const InputError& error) {
      std::vector<Problem> problems = error.problems();
      for (Problem& problem : problems) problem.pointer = child("/commands", i) + "/body" + problem.pointer;
      throw InputError(std::move(problems));
    }
  }
}

std::vector<std::string> read_tags(const Json& json) {
  std::vector<std::string> tags;
  if (!holds(json, "tags", &Json::is_array)) return tags;
  for (const Json& tag : json.at("tags")) {
    if (tag.is_string() && tag.get_ref<const std::string&>().size() <= 64 && tags.size() < 32) tags.push_back(tag);
  }
  std::erase(tags, "demo");
  return tags;
}

std::string text_of(const Json& json, const char* key) {
  return holds(json, key, &Json::is_string) ? json.at(key).get<std::string>() : std::string();
}

}  // namespace

Json bundle_head(const RunRow& run, const std::vector<Signal>& signals, const std::optional<std::string>& trace) {
  Json bundle;
  bundle["vigil_bundle"] = 1;
  bundle["version"] = run.version;
  bundle["cpu"] = run.cpu;
  bundle["scenario"] = run.scenario;
  bundle["seed"] = run.seed;
  bundle["state"] = run.state;
  bundle["k"] = run.k;
  bundle["document"] = run.document;
  bundle["commands"] = Json::array();
  for (const Command& command : run.commands) bundle["commands"].push_back({{"k", command.k}, {"body", command.body}});
  bundle["trace"] = trace ? Json(*trace) : Json();
  bundle["designs"] = run.designs.is_null() ? Json::object() : run.designs;
  bundle["metrics"] = Json::array();
  for (const MetricValue& metric : run.metrics) bundle["metrics"].push_back(to_json(metric));
  bundle["faults"] = Json::array();
  for (const FaultCount& fault : run.faults) bundle["faults"].push_back(to_json(fault));
  bundle["design"] = run.design;
  bundle["warnings"] = run.warnings;
  bundle["tags"] = run.tags;
  bundle["note"] = run.note;
  bundle["signals"] = Json::array();
  for (const Signal& signal : signals) bundle["signals"].push_back(to_json(signal));
  return bundle;
}

bool is_bundle(const Json& json) { return json.is_object() && json.contains("vigil_bundle"); }

Bundle read_bundle(const Json& json) {
  if (!is_bundle(json)) throw InputError("", "this is no bundle: it lacks \"vigil_bundle\"", "a bundle");
  required(json, "vigil_bundle", json.at("vigil_bundle") == 1, "1, the version of the format");
  Bundle bundle;
  RunOrder& order = bundle.order;
  order.scenario = read_document(required(json, "document", holds(json, "document", &Json::is_object), "an object"));
  const bool seed =
      holds(json, "seed", &Json::is_number_unsigned) && json.at("seed").get<std::uint64_t>() <= kLargestSeed;
  order.seed = required(json, "seed", seed, "an integer from 0 to 9007199254740991").get<std::uint64_t>();
  if (json.contains("commands")) {
    order.commands = read_commands(required(json, "commands", holds(json, "commands", &Json::is_array), "an array"));
  }
  if (json.contains("k")) {
    const bool tick = json.at("k").is_number_integer() && json.at("k").get<std::int64_t>() >= -1;
    const auto last = required(json, "k", tick, "the last tick, an integer").get<std::int64_t>();
    if (last >= 0) order.last = last;
  }
  if (json.contains("trace") && !json.at("trace").is_null()) {
    bundle.trace_csv = required(json, "trace", json.at("trace").is_string(), "a CSV text or null").get<std::string>();
    order.trace = std::make_shared<const Trace>(Trace::from_csv(bundle.trace_csv));
  }
  if (json.contains("designs")) {
    order.designs = required(json, "designs", holds(json, "designs", &Json::is_object), "an object");
    check_designs(order.scenario, order.designs);
  }
  if (!order.commands.empty()) check_commands(order);
  // What ended by a command, a kill or its own steps ends again at the same tick, and says so.
  const std::string state = text_of(json, "state");
  if (state == "stopped" || state == "interrupted") order.end_state = "stopped";
  order.tags = read_tags(json);
  order.note = text_of(json, "note").substr(0, 4000);
  if (!is_utf8(order.note)) order.note.clear();
  bundle.version = text_of(json, "version");
  bundle.cpu = text_of(json, "cpu");
  return bundle;
}

}  // namespace vigil
