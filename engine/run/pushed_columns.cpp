#include "engine/run/pushed_columns.hpp"

#include <algorithm>
#include <unordered_set>

#include "engine/adversary/attack.hpp"
#include "engine/core/describe.hpp"
#include "engine/run/adversary.hpp"
#include "engine/run/setup.hpp"

namespace vigil {
namespace {

constexpr std::size_t kMostFurther = 10'000;
constexpr const char* kPointer = "/input/ingest/columns";

void add(PushedColumns& columns, std::string name, int reporter) {
  columns.names.push_back(std::move(name));
  columns.reporter.push_back(reporter);
}

void add_nodes(PushedColumns& columns, const Json& nodes, const Plant& plant) {
  for (const auto& [id, node] : nodes.items()) {
    const Json& sensor = node["sensor"];
    const std::string pointer = "/nodes/" + id + "/sensor";
    const auto& entry = entry_of<SensorMake>(sensor["type"].get<std::string>(), pointer + "/type");
    const auto made = under(pointer + "/params", [&] { return entry.make(Params(sensor["params"]), plant); });
    const int reporter = static_cast<int>(columns.nodes.size());
    for (const Component& c : made->channels()) add(columns, "sensor." + id + "." + c.name, reporter);
    columns.nodes.push_back(id);
  }
}

/// "sensor.<node>.…" belongs to its node: what it says of a reading comes with the reading.
int reporter_of(const std::string& name, const std::vector<std::string>& nodes) {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (name.starts_with("sensor." + nodes[i] + ".")) return static_cast<int>(i);
  }
  return -1;
}

}  // namespace

PushedColumns pushed_columns(const Scenario& scenario, const std::vector<std::string>& further) {
  const Json& document = scenario.document();
  PushedColumns columns;
  const double dt = document.at("time").at("dt").get<double>();
  const auto& entry = entry_of<PlantMake>(document["plant"]["type"].get<std::string>(), "/plant/type");
  const auto plant = under("/plant/params", [&] { return entry.make(Params(document["plant"]["params"]), dt); });
  add_nodes(columns, document["nodes"], *plant);
  columns.inputs = !plant->input().empty();
  for (const Component& c : plant->input()) add(columns, "input." + c.name, -1);
  for (const Component& c : plant->state()) add(columns, "truth." + c.name, -1);
  if (further.size() > kMostFurther)
    throw InputError(kPointer, "columns has more than " + std::to_string(kMostFurther) + " names");
  std::unordered_set<std::string> known(columns.names.begin(), columns.names.end());
  for (std::size_t i = 0; i < further.size(); ++i) {
    const std::string& name = further[i];
    if (name.empty() || name.size() > 256 || !is_utf8(name) ||
        !std::all_of(name.begin(), name.end(), [](unsigned char c) { return c > 0x20 && c != 0x7F && c != '"'; }))
      throw InputError(child(kPointer, i), "the column is " + in_quotes(name) + "; expected a signal's name");
    if (!known.insert(name).second)
      throw InputError(child(kPointer, i), "the column " + in_quotes(name) + " is there already");
    add(columns, name, reporter_of(name, columns.nodes));
  }
  return columns;
}

void check_pushed(const PushedColumns& columns, const Catalogue& catalogue) {
  for (const std::string& name : columns.names) {
    if (catalogue.find(name) < 0)
      throw InputError(kPointer, "the run has no signal " + in_quotes(name), "names of GET /runs/{id}/signals");
  }
}

std::optional<int> largest_state(std::string_view column) {
  if (!column.ends_with(".state")) return std::nullopt;
  if (column.starts_with("link.")) return static_cast<int>(LinkState::replay);
  const bool sensor = column.starts_with("sensor.") ||
                      (column.starts_with("lane.") && column.find(".sensor.") != std::string_view::npos);
  return sensor ? std::optional<int>(static_cast<int>(SensorState::type_r)) : std::nullopt;
}

}  // namespace vigil
