/// LogReader's marks, in the order of their ticks.
#include <algorithm>
#include <charconv>

#include "db/reader_state.hpp"

namespace vigil {

namespace {

/// "<k>.<serial>" of the last mark given.
struct Place {
  std::int64_t k = -1, serial = 0;
};

Place read_place(const std::string& cursor) {
  Place place;
  if (cursor.empty()) return place;
  const char* const end = cursor.data() + cursor.size();
  const auto [dot, error] = std::from_chars(cursor.data(), end, place.k);
  if (error == std::errc() && dot != end && *dot == '.') {
    const auto [rest, bad] = std::from_chars(dot + 1, end, place.serial);
    if (bad == std::errc() && rest == end) return place;
  }
  throw QueryError(0, "this cursor does not belong to a list of marks; start again without one.");
}

MarkType type_of(const std::string& name) {
  for (const auto type : {MarkType::attack, MarkType::alarm, MarkType::fault, MarkType::command, MarkType::state}) {
    if (to_string(type) == name) return type;
  }
  return MarkType::note;
}

MarkEdge edge_of(const std::string& name) {
  if (name == "begin") return MarkEdge::begin;
  return name == "end" ? MarkEdge::end : MarkEdge::none;
}

std::string places(std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) text += i == 0 ? "?" : ",?";
  return text;
}

Mark mark_of(const Statement& query) {
  Mark mark;
  mark.k = query.integer(1);
  mark.type = type_of(query.text(2));
  mark.edge = edge_of(query.text(3));
  mark.id = query.text(4);
  mark.lane = query.text(5);
  mark.node = query.text(6);
  mark.link = query.text(7);
  mark.code = query.text(8);
  mark.detail = query.text(9);
  return mark;
}

}  // namespace

MarkPage LogReader::marks(RunId run, const MarkFilter& filter) const {
  if (filter.limit < 1 || filter.limit > 100000) {
    throw QueryError(0, "limit is " + std::to_string(filter.limit) + "; expected 1 to 100000.");
  }
  const Place after = read_place(filter.cursor);
  std::string sql =
      "SELECT id,k,type,edge,ref,lane,node,link,code,detail FROM mark WHERE run=? AND k>=? AND k<=? AND (k,id)>(?,?)";
  if (!filter.types.empty()) sql += " AND type IN(" + places(filter.types.size()) + ")";
  if (!filter.lanes.empty()) sql += " AND lane IN(" + places(filter.lanes.size()) + ")";
  sql += " ORDER BY k,id LIMIT ?";
  const auto database = state_->lease();
  auto query = database->statement(sql);
  const auto from = std::max(filter.from.value_or(0), std::max<std::int64_t>(0, after.k));
  query.all(run, from, filter.to.value_or(INT64_MAX), after.k, after.serial);
  int index = 5;
  for (const auto type : filter.types) query.bind(++index, to_string(type));
  for (const auto& lane : filter.lanes) query.bind(++index, lane);
  query.bind(++index, filter.limit + 1);
  MarkPage page;
  while (query.step()) {
    if (page.items.size() == static_cast<std::size_t>(filter.limit)) {
      const auto& last = page.items.back();
      page.next = std::to_string(last.mark.k) + "." + std::to_string(last.serial);
      break;
    }
    page.items.push_back({query.integer(0), mark_of(query)});
  }
  return page;
}

}  // namespace vigil
