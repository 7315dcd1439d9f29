#include "engine/run/frame.hpp"

#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "engine/core/describe.hpp"
#include "engine/core/input_error.hpp"

namespace vigil {
namespace {

constexpr std::array<std::pair<MarkType, std::string_view>, 6> kTypes{{{MarkType::attack, "attack"},
                                                                       {MarkType::alarm, "alarm"},
                                                                       {MarkType::fault, "fault"},
                                                                       {MarkType::command, "command"},
                                                                       {MarkType::state, "state"},
                                                                       {MarkType::note, "note"}}};

std::string_view kind_text(SignalKind kind) {
  switch (kind) {
    case SignalKind::scalar:
      return "scalar";
    case SignalKind::boolean:
      return "bool";
    case SignalKind::category:
      return "category";
  }
  return "";
}

Json text_or_null(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

MarkType type_from(const Json& value) {
  for (const auto& [type, word] : kTypes) {
    if (value.is_string() && value.get_ref<const std::string&>() == word) return type;
  }
  throw InputError("/type", "type is " + shown(value) + "; expected one of attack, alarm, fault, command, state, note",
                   "attack, alarm, fault, command, state, note");
}

MarkEdge edge_from(const Json& value) {
  if (value.is_null()) return MarkEdge::none;
  if (value == "begin") return MarkEdge::begin;
  if (value == "end") return MarkEdge::end;
  throw InputError("/edge", "edge is " + shown(value) + "; expected begin, end or null", "begin, end, null");
}

std::string text_from(const Json& json, const char* key) {
  const auto place = json.find(key);
  if (place == json.end() || place->is_null()) return {};
  if (!place->is_string())
    throw InputError(child("", key), std::string(key) + " is " + shown(*place) + "; expected a text", "text");
  return place->get<std::string>();
}

std::int64_t tick_from(const Json& json) {
  const auto place = json.find("k");
  if (place != json.end() && place->is_number_integer()) return place->get<std::int64_t>();
  throw InputError("/k", "k is " + (place == json.end() ? "missing" : shown(*place)) + "; expected a tick (an integer)",
                   "integer");
}

}  // namespace

Json to_json(const Signal& signal) {
  Json labels = Json::object();
  for (const auto& [value, word] : signal.labels) labels[std::to_string(value)] = word;
  return {{"id", signal.id},
          {"name", signal.name},
          {"unit", signal.unit},
          {"kind", kind_text(signal.kind)},
          {"lane", text_or_null(signal.lane)},
          {"node", text_or_null(signal.node)},
          {"link", text_or_null(signal.link)},
          {"labels", std::move(labels)}};
}

int Catalogue::add(Signal signal) {
  signal.id = size();
  if (!ids_.emplace(signal.name, signal.id).second)
    throw std::logic_error("signal " + signal.name + " is there already");
  signals_.push_back(std::move(signal));
  return signals_.back().id;
}

int Catalogue::find(std::string_view name) const {
  const auto place = ids_.find(std::string(name));
  return place == ids_.end() ? -1 : place->second;
}

std::string_view to_string(MarkType type) {
  for (const auto& [known, word] : kTypes) {
    if (known == type) return word;
  }
  return "";
}

std::string_view to_string(MarkEdge edge) {
  if (edge == MarkEdge::begin) return "begin";
  if (edge == MarkEdge::end) return "end";
  return "";
}

Json to_json(const Mark& mark) {
  Json json = {{"k", mark.k}, {"type", to_string(mark.type)}};
  json["edge"] = mark.edge == MarkEdge::none ? Json(nullptr) : Json(to_string(mark.edge));
  const auto put = [&json](const char* key, const std::string& text) {
    if (!text.empty()) json[key] = text;
  };
  put("id", mark.id);
  put("lane", mark.lane);
  put("node", mark.node);
  put("link", mark.link);
  put("code", mark.code);
  put("detail", mark.detail);
  return json;
}

Mark mark_from_json(const Json& json) {
  if (!json.is_object()) throw InputError("", "a mark is " + shown(json) + "; expected an object", "object");
  Mark mark;
  mark.k = tick_from(json);
  mark.type = type_from(json.value("type", Json(nullptr)));
  mark.edge = edge_from(json.value("edge", Json(nullptr)));
  mark.id = text_from(json, "id");
  mark.lane = text_from(json, "lane");
  mark.node = text_from(json, "node");
  mark.link = text_from(json, "link");
  mark.code = text_from(json, "code");
  mark.detail = text_from(json, "detail");
  return mark;
}

}  // namespace vigil
