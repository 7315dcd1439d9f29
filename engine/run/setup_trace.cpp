/// A trace takes the place of the world: does it fit, and where do its columns stand.
#include <fmt/format.h>

#include <cmath>

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

void Run::State::find_columns() {
  const auto find = [&](const std::string& name) { return trace ? trace->find(name) : -1; };
  for (const Component& c : plant->state()) columns.truth.push_back(find("truth." + c.name));
  for (const Component& c : plant->input()) columns.input.push_back(find("input." + c.name));
  bool any = false;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    columns.sensor_state.push_back(find("sensor." + nodes[i] + ".state"));
    if (columns.sensor_state.back() >= 0)
      check_states(*trace, columns.sensor_state.back(), static_cast<int>(SensorState::type_r));
    for (auto* group : {&columns.sensor, &columns.sent, &columns.tampered}) group->emplace_back();
    for (const Component& c : sensors[i]->channels()) {
      const std::string name = "sensor." + nodes[i] + "." + c.name;
      columns.sensor.back().push_back(find(name));
      columns.sent.back().push_back(find(name + ".sent"));
      columns.tampered.back().push_back(find(name + ".injected"));
      any = any || columns.sensor.back().back() >= 0;
    }
  }
  for (const Link& link : base.links()) {
    const std::string name =
        "link." + nodes[static_cast<std::size_t>(link.from)] + "-" + nodes[static_cast<std::size_t>(link.to)];
    columns.link_state.push_back(find(name + ".state"));
    if (columns.link_state.back() >= 0)
      check_states(*trace, columns.link_state.back(), static_cast<int>(LinkState::replay));
    columns.injected.emplace_back();
    for (const Component& c : plant->state()) columns.injected.back().push_back(find(name + ".injected." + c.name));
  }
  if (!trace) {
    if (plant->inputs() > 0) {
      throw InputError("/plant/type",
                       "this plant is driven by a recorded input, so the run needs a trace (--trace FILE, or "
                       "\"input\":{\"trace\":id})");
    }
    return;
  }
  if (!any)
    throw InputError("/input/trace", "the trace has no column sensor.<node>.<channel> of this scenario's nodes");
  for (std::size_t c = 0; c < columns.input.size(); ++c) {
    if (columns.input[c] < 0)
      throw InputError("/input/trace",
                       "the trace has no column input." + plant->input()[c].name + ", which the plant needs");
  }
}

}  // namespace vigil
