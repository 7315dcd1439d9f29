#include "server/synthesis/design_item.hpp"

#include <utility>

namespace vigil {
namespace {

std::string text_of(const Json& record, const char* key) {
  const auto place = record.find(key);
  return place != record.end() && place->is_string() ? place->get<std::string>() : std::string();
}

bool holds(const Json& record) { return record.is_object() && record.contains("holds") && record.at("holds") == true; }

/// The certificate's reason, and what the solver said where it is the reason of that.
std::string reason_of(const Json& record) {
  const std::string verdict = text_of(record, "verdict"), detail = text_of(record, "detail");
  std::string reason = text_of(record, "reason");
  std::string because;
  if (verdict == "infeasible") because = "the solver finds that the inequalities have no solution";
  if ((verdict == "timed_out" || verdict == "failed") && detail != reason) because = detail;
  if (!reason.empty() && !because.empty()) reason += ": ";
  return reason + because;
}

}  // namespace

std::string_view to_string(DesignItem::State state) {
  switch (state) {
    case DesignItem::State::queued:
      return "queued";
    case DesignItem::State::solving:
      return "solving";
    case DesignItem::State::done:
      return "done";
    case DesignItem::State::refused:
      return "refused";
  }
  return "refused";
}

Json to_json(const DesignItem& item) {
  return {{"lane", item.lane},
          {"key", item.key},
          {"state", to_string(item.state)},
          {"seconds", item.seconds},
          {"limit", item.limit},
          {"record", item.record},
          {"reason", item.state == DesignItem::State::refused ? Json(item.reason) : Json()}};
}

DesignItem settle(DesignItem item, Json record) {
  item.state = holds(record) ? DesignItem::State::done : DesignItem::State::refused;
  if (record.is_object()) {
    const auto seconds = record.find("seconds");
    if (seconds != record.end() && seconds->is_number()) item.seconds = seconds->get<double>();
    if (item.reason.empty()) item.reason = reason_of(record);
  }
  if (item.state == DesignItem::State::done) item.reason.clear();
  if (item.state == DesignItem::State::refused && item.reason.empty()) item.reason = "no certified gains were found";
  item.record = std::move(record);
  return item;
}

bool may_be_tried_again(const DesignItem& item) {
  if (item.state != DesignItem::State::refused) return false;
  if (!item.record.is_object()) return true;
  const std::string verdict = text_of(item.record, "verdict");
  return verdict == "timed_out" || verdict == "failed";
}

}  // namespace vigil
