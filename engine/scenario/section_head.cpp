/// Who the scenario is and how its time runs; what is kept of it.
#include "engine/core/describe.hpp"
#include "engine/scenario/fields.hpp"
#include "engine/scenario/sections.hpp"

namespace vigil::section {
namespace {

bool is_scenario_id(std::string_view text) {
  const auto allowed = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-'; };
  return is_id(text, 64, allowed) && text.front() != '-';
}

/// A section's object, {} where it is not given.
Json member(const Json& given, const char* key) {
  const auto place = given.find(key);
  return place == given.end() ? Json::object() : *place;
}

}  // namespace

Json id(const Json& given, std::vector<Problem>& problems) {
  Fields fields(given, "", problems);
  const std::string expected = "an id of small letters, digits and '-', up to 64, beginning with a letter or digit";
  if (!fields.has("id")) {
    fields.missing("id", expected);
    return "";
  }
  const Json& value = fields.at("id");
  if (value.is_string() && is_scenario_id(value.get_ref<const std::string&>())) return value;
  fields.wrong("id", expected);
  return "";
}

Json title(const Json& given, const Json& document, std::vector<Problem>& problems) {
  const Json fallback = document.value("id", Json(""));
  Fields root(given, "", problems);
  if (!root.has("title")) return {{"en", fallback}, {"zh", fallback}};
  if (root.at("title").is_string()) return {{"en", root.at("title")}, {"zh", root.at("title")}};
  if (!root.at("title").is_object()) {
    root.wrong("title", "a text or {\"en\",\"zh\"}");
    return {{"en", fallback}, {"zh", fallback}};
  }
  Fields fields(root.at("title"), "/title", problems);
  fields.known({"en", "zh"});
  const Json english = fields.text("en", fields.has("zh") ? fields.at("zh") : fallback);
  return {{"en", english}, {"zh", fields.text("zh", english)}};
}

Json time(const Json& given, std::vector<Problem>& problems) {
  const Json section = member(given, "time");
  Fields fields(section, "/time", problems);
  fields.known({"dt", "steps"});
  return {{"dt", fields.positive("dt", 1, false)}, {"steps", fields.integer("steps", nullptr, 1, true)}};
}

namespace {

/// {"from","to"}: ticks, both ends included.
Json window(Fields& fields) {
  const Json from = fields.integer("from", 0, 0, false);
  const Json to = fields.integer("to", nullptr, 0, true);
  if (to.is_number() && to < from) fields.wrong("to", "a tick not before from (" + from.dump() + ") or null");
  return {{"from", from}, {"to", to}};
}

Json mse(const Json& given, std::vector<Problem>& problems) {
  constexpr std::size_t kMost = 32;
  Json result = Json::object();
  const Fields checked(given, "/metrics/mse", problems);
  if (!given.is_object()) return result;
  if (given.size() > kMost)
    problems.push_back(
        {"/metrics/mse", "mse has " + std::to_string(given.size()) + " members; expected at most 32", {}});
  for (const auto& [name, figure] : given.items()) {
    const std::string pointer = child("/metrics/mse", name);
    if (!is_member_id(name) || !name.starts_with("mse_")) {
      problems.push_back(
          {pointer,
           in_quotes(name) + " is no name of a figure; expected mse_ and small letters, digits and '_', up to 32",
           "mse_[a-z0-9_]{1,28}"});
      continue;
    }
    Fields fields(figure, pointer, problems);
    fields.known({"component", "from", "to"});
    if (figure.is_object() && !fields.has("component")) fields.missing("component", "the name of a state component");
    result[name] = {{"component", fields.text("component", "")}};
    result[name].update(window(fields));
  }
  return result;
}

}  // namespace

Json metrics(const Json& given, std::vector<Problem>& problems) {
  const Json section = member(given, "metrics");
  Fields fields(section, "/metrics", problems);
  fields.known({"window", "mse", "detection", "state"});
  Json result = Json::object();
  if (fields.has("window")) {
    Fields ticks(fields.at("window"), "/metrics/window", problems);
    ticks.known({"from", "to"});
    result["window"] = window(ticks);
  }
  for (const auto& [key, fallback] : {std::pair{"detection", 50}, std::pair{"state", 20}}) {
    if (!fields.has(key)) continue;
    Fields start(fields.at(key), std::string("/metrics/") + key, problems);
    start.known({"from"});
    result[key] = {{"from", start.integer("from", fallback, 0, false)}};
  }
  if (fields.has("mse")) result["mse"] = mse(fields.at("mse"), problems);
  return result;
}

Json log(const Json& given, std::vector<Problem>& problems) {
  const Json section = member(given, "log");
  Fields fields(section, "/log", problems);
  fields.known({"signals", "every", "keep", "policy"});
  return {{"signals", fields.texts("signals", Json::array({"*"}))},
          {"every", fields.integer("every", 1, 1, false)},
          {"keep", fields.positive("keep", nullptr, true)},
          {"policy", fields.choice("policy", {"lossless", "live"}, nullptr)}};
}

Json view(const Json& given, std::vector<Problem>& problems) {
  const Json section = member(given, "view");
  const Fields checked(section, "/view", problems);
  return section.is_object() ? section : Json::object();
}

}  // namespace vigil::section
