/// A trace takes the place of the world: does it fit, and where do its columns stand.
#include <fmt/format.h>

#include <cmath>

#include "engine/run/setup.hpp"
#include "engine/run/state.hpp"

namespace vigil {
namespace {

/// The state of a link (0 to 3, as the contract has it) or of a sensor (0 to 6) is one of those, or missing.
void check_states(const Trace& trace, int column, int last) {
  for (std::int64_t k = trace.first_tick(); k < trace.first_tick() + trace.rows(); ++k) {
    const double state = trace.at(k, column);
    if (std::isnan(state) || (state >= 0 && state <= last && state == std::floor(state))) continue;
    std::string allowed;
    for (int s = 0; s <= last; ++s)
      allowed += fmt::format("{}{} {}", s == 0 ? "" : ", ", s, word(static_cast<SensorState>(s)));
    const std::string& name = trace.columns()[static_cast<std::size_t>(column)];
    throw InputError("/input/trace",
                     fmt::format("{} is {} at tick {}; expected {} or nothing", name, state, k, allowed), allowed);
  }
}

}  // namespace

void Run::State::check_trace(const Json& /*document*/) {
  if (trace->grows()) return;  // it has no end, and its rows are as far apart as the document says
  if (trace->first_tick() != 0) {
    throw InputError("/input/trace", fmt::format("the trace begins at tick {}; a run begins at 0", trace->first_tick()),
                     "k = 0 in its first row");
  }
  if (trace->rows() > 1 && std::abs(trace->dt() - dt) > 1e-6 * dt) {
    throw InputError(
        "/time/dt",
        fmt::format("dt is {} s and the trace has {} s between its rows; they must be the same", dt, trace->dt()));
  }
  const std::int64_t end = trace->rows() - 1;
  last_tick = last_tick ? std::min(*last_tick, end) : end;
}

/// Where the columns of the shared course ("") or of a lane's own ("lane.<lane>.") stand.
CourseColumns Run::State::course_columns(const std::string& prefix) const {
  const auto find = [&](const std::string& name) { return trace ? trace->find(prefix + name) : -1; };
  CourseColumns found;
  for (const Component& c : world.plant->state()) found.truth.push_back(find("truth." + c.name));
  for (const Component& c : world.plant->input()) found.input.push_back(find("input." + c.name));
  for (const std::string& name : drive_names(world, nodes)) found.drives.push_back(name.empty() ? -1 : find(name));
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    found.sensor_state.push_back(find("sensor." + nodes[i] + ".state"));
    if (found.sensor_state.back() >= 0)
      check_states(*trace, found.sensor_state.back(), static_cast<int>(SensorState::type_r));
    for (auto* group : {&found.sensor, &found.sent, &found.tampered, &found.source}) group->emplace_back();
    for (const Component& c : world.sensors[i]->channels()) {
      const std::string name = "sensor." + nodes[i] + "." + c.name;
      found.sensor.back().push_back(find(name));
      found.sent.back().push_back(find(name + ".sent"));
      found.tampered.back().push_back(find(name + ".injected"));
      found.source.back().push_back(find(name + ".source"));
      found.readings = found.readings || found.sensor.back().back() >= 0;
    }
  }
  return found;
}

void Run::State::find_columns() {
  columns.shared = course_columns("");
  const auto find = [&](const std::string& name) { return trace ? trace->find(name) : -1; };
  for (const Link& link : base.links()) {
    const std::string name = "link." + link_name(link, nodes);
    columns.link_state.push_back(find(name + ".state"));
    columns.source.push_back(find(name + ".source"));
    columns.overheard.push_back(find(name + ".overheard"));
    if (columns.link_state.back() >= 0)
      check_states(*trace, columns.link_state.back(), static_cast<int>(LinkState::replay));
    columns.injected.emplace_back();
    for (const Component& c : world.plant->state())
      columns.injected.back().push_back(find(name + ".injected." + c.name));
  }
  const int inputs = world.plant->inputs();
  if (!trace) {
    // The input of a linear plant that nobody drives is zero.
    if (inputs > 0 && !world.controller && world.continuous() == nullptr && !world.plant->linear()) {
      throw InputError("/plant/type",
                       "this plant is driven by a recorded input, so the run needs a trace (--trace FILE, or "
                       "\"input\":{\"trace\":id}) or a controller");
    }
    return;
  }
  if (!columns.shared.readings)
    throw InputError("/input/trace", "the trace has no column sensor.<node>.<channel> of this scenario's nodes");
  for (std::size_t c = 0; c < columns.shared.input.size(); ++c) {
    if (columns.shared.input[c] < 0 && world.continuous() == nullptr)
      throw InputError("/input/trace",
                       "the trace has no column input." + world.plant->input()[c].name + ", which the plant needs");
  }
}

}  // namespace vigil
