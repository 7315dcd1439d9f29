/// The contenders.
#include "engine/core/describe.hpp"
#include "engine/methods/detectors/detector.hpp"
#include "engine/methods/privacy/protection.hpp"
#include "engine/scenario/fields.hpp"
#include "engine/scenario/sections.hpp"
#include "engine/scenario/typed.hpp"

namespace vigil::section {
namespace {

/// {"type":"none"} or a registered protection or detector with its params.
template <class Make>
Json optional(const char* kind, const Json& given, const std::string& pointer, std::vector<Problem>& problems) {
  Json result = {{"type", "none"}};
  Fields fields(given, pointer, problems);
  if (!given.is_object()) return result;
  if (given.value("type", Json("none")) == "none") {
    fields.known({"type"});
    return result;
  }
  fields.known({"type", "params"});
  complete_typed<Make>(fields, "type", kind, result, problems);
  return result;
}

Json lane(const Json& given, const std::string& pointer, std::vector<Problem>& problems) {
  Json result = Json::object();
  Fields fields(given, pointer, problems);
  if (!given.is_object()) return result;
  fields.known({"method", "path", "adversary", "enabled", "params", "protection", "detector"});
  Json typed = Json::object();
  complete_typed<MethodMake>(fields, "method", "method", typed, problems);
  result["method"] = typed.value("method", Json(""));
  result["path"] = fields.choice("path", {"loop", "monitor"}, "loop");
  result["adversary"] = fields.boolean("adversary", true);
  result["enabled"] = fields.boolean("enabled", true);
  result["params"] = typed.value("params", Json::object());
  if (fields.has("protection"))
    result["protection"] =
        optional<ProtectionMake>("protection", fields.at("protection"), fields.pointer("protection"), problems);
  if (fields.has("detector"))
    result["detector"] =
        optional<DetectorMake>("detector", fields.at("detector"), fields.pointer("detector"), problems);
  return result;
}

}  // namespace

Json lanes(const Json& given, std::vector<Problem>& problems) {
  Json result = Json::object();
  Fields root(given, "", problems);
  const std::string expected = "an object of 1 to " + std::to_string(kMostLanes) + " lanes keyed by their ids";
  if (!root.has("lanes")) {
    root.missing("lanes", expected);
    return result;
  }
  const Json& list = root.at("lanes");
  if (!list.is_object() || list.empty() || list.size() > kMostLanes) {
    const std::string found =
        list.is_object() ? "has " + std::to_string(list.size()) + " members" : "is " + shown(list);
    problems.push_back({"/lanes", "lanes " + found + "; expected " + expected, expected});
    return result;
  }
  for (const auto& [key, value] : list.items()) {
    const std::string pointer = child("/lanes", key);
    if (is_member_id(key)) {
      result[key] = lane(value, pointer, problems);
    } else {
      problems.push_back({pointer, in_quotes(key) + " is no lane id; expected 1 to 32 small letters, digits and '_'",
                          "[a-z0-9_]{1,32}"});
    }
  }
  return result;
}

}  // namespace vigil::section
