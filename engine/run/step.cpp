/// One tick, in the order of the design.
#include <cmath>

#include "engine/core/missing.hpp"
#include "engine/run/sensor_signals.hpp"
#include "engine/run/state.hpp"

namespace vigil {
void Run::State::step(Sink& sink) {
  ++k;
  if (k == 0) {
    begin(sink);
  } else {
    while (!pending.empty() && pending.front().k <= k) {
      const Command command = pending.front();
      pending.erase(pending.begin());
      change(command, &sink);
    }
    effects.clear();
    sensor_effects.clear();
    world.actuators.clear();
    trace ? replay(sink) : simulate(sink);
  }
  const Tick tick{k, trace != nullptr, world, shared, graph, base_of, effects, sensor_effects};
  for (Lane& lane : lanes) k > 0 ? lane.tick(tick) : lane.begin(tick);
  std::fill(frame.values.begin(), frame.values.end(), kMissing);
  frame.k = k;
  frame.t = static_cast<double>(k) * dt;
  publish_world();
  for (Lane& lane : lanes) {
    lane.publish(tick, frame.values);
    lane.mark_edges(k, sink);
  }
  // A plant may overflow (a document can ask for 1e300): a frame says that as missing, never as infinity.
  for (double& value : frame.values) value = std::isfinite(value) ? value : kMissing;
  sink.frame(frame);
}

/// Tick 0 has no step of the plant; to a fusion centre sensors speak already, and somebody may listen.
void Run::State::begin(Sink& sink) {
  if (world.continuous() != nullptr) begin_flow();
  if (world.controller && !trace) world.controller->input(0, shared.truth.data(), shared.upcoming);
  if (base.centre() < 0) return;
  effects.clear();
  sensor_effects.clear();
  adversary.act(0, effects, sensor_effects, world.actuators, sink);
  sensor_effects.clear();
  if (trace) override_links();
}

/// Tick 0 of continuous time has readings: observers start from them.
void Run::State::begin_flow() {
  if (!trace) return shared.begin_flow(world);
  read_course(columns.shared, shared);
  shared.readings = shared.sent;
  shared.received = shared.sent;
}

/// Steps 1 to 3 of what lanes share. A controlled reference follows its own truth.
void Run::State::simulate(Sink& sink) {
  world.draw(k);
  adversary.act(k, effects, sensor_effects, world.actuators, sink);
  shared.advance(world, k, true);
  if (world.controller) world.controller->input(k, shared.truth.data(), shared.upcoming);
  shared.sense(world);
  shared.sent = shared.readings;
  channels.carry(k, world, sensor_effects, shared);
}

/// The same from a trace. Channels that it describes bypass the adversary; elsewhere the adversary acts.
void Run::State::replay(Sink& sink) {
  read_course(columns.shared, shared);
  adversary.act(k, effects, sensor_effects, world.actuators, sink);
  override_links();
  channels.carry(k, world, sensor_effects, shared);
  read_tampering(columns.shared, shared, sensor_effects);
  shared.readings = shared.sent;
  for (std::size_t l = 0; l < lanes.size(); ++l) {
    if (l >= columns.lanes.size() || !columns.lanes[l].readings) continue;
    Course& course = lanes[l].contender().course();
    SensorEffects& own = lanes[l].recorded_effects();
    own.clear();
    read_course(columns.lanes[l], course);
    course.received = course.sent;
    read_tampering(columns.lanes[l], course, own);
  }
}

void Run::State::read_course(const CourseColumns& from, Course& course) const {
  const auto read = [&](int column) { return column < 0 ? kMissing : trace->at(k, column); };
  for (std::size_t c = 0; c < from.input.size(); ++c) {
    double& held = course.input[static_cast<Eigen::Index>(c)];
    const double value = read(from.input[c]);
    if (std::isfinite(value)) held = value;  // a missing input holds the last one, or is none
    if (!std::isfinite(held)) held = 0;
  }
  for (std::size_t c = 0; c < from.drives.size(); ++c)
    course.drives[static_cast<Eigen::Index>(c)] = read(from.drives[c]);
  for (Eigen::Index c = 0; c < course.truth.size(); ++c)
    course.truth[c] = read(from.truth[static_cast<std::size_t>(c)]);
  for (std::size_t i = 0; i < course.sent.size(); ++i) {
    for (Eigen::Index c = 0; c < course.sent[i].size(); ++c)
      course.sent[i][c] = read(from.sensor[i][static_cast<std::size_t>(c)]);
  }
}

/// A sensor whose `injected`, `source` or `state` columns the trace has bypasses the adversary: the reading is there as
/// received, and beside it the honest one.
void Run::State::read_tampering(const CourseColumns& from, Course& course, SensorEffects& tampering) const {
  const auto read = [&](int column) { return column < 0 ? kMissing : trace->at(k, column); };
  for (std::size_t i = 0; i < course.sent.size(); ++i) {
    bool described = from.sensor_state[i] >= 0, added = false;
    for (const int column : from.tampered[i]) described = described || column >= 0;
    for (const int column : from.source[i]) described = described || column >= 0;
    if (!described) continue;
    for (Eigen::Index c = 0; c < course.sent[i].size(); ++c) {
      const auto channel = static_cast<std::size_t>(c);
      const double injected = read(from.tampered[i][channel]), honest = read(from.sent[i][channel]);
      const double source = read(from.source[i][channel]);
      course.received[i][c] = read(from.sensor[i][channel]);
      course.sent[i][c] = std::isfinite(honest) ? honest : course.received[i][c];
      tampering.injected[i][c] = std::isfinite(injected) ? injected : 0;
      course.injected[i][c] = tampering.injected[i][c];
      added = added || tampering.injected[i][c] != 0;
      tampering.playback[i][channel] = {};
      if (source >= 0 && source < static_cast<double>(k)) {
        const auto tick = static_cast<std::int64_t>(source);
        tampering.playback[i][channel] = {tick, tick, tick};
      }
    }
    const bool played = tampering.plays(static_cast<int>(i));
    tampering.state[i] = played ? SensorState::replay : (added ? SensorState::fdi : SensorState::clean);
    const double state = read(from.sensor_state[i]);
    if (std::isfinite(state)) tampering.state[i] = static_cast<SensorState>(static_cast<int>(state));
  }
}

/// Channels that the trace describes bypass the adversary.
void Run::State::override_links() {
  for (std::size_t l = 0; l < columns.link_state.size(); ++l) {
    const auto link = static_cast<Eigen::Index>(l);
    if (columns.overheard[l] >= 0) effects.overheard[l] = trace->at(k, columns.overheard[l]) > 0 ? 1 : 0;
    bool described = columns.link_state[l] >= 0;
    for (const int column : columns.injected[l]) described = described || column >= 0;
    if (!described) continue;
    const double state = columns.link_state[l] < 0 ? 0 : trace->at(k, columns.link_state[l]);
    effects.state[l] = std::isfinite(state) ? static_cast<LinkState>(static_cast<int>(state)) : LinkState::clean;
    for (Eigen::Index c = 0; c < effects.injected.rows(); ++c) {
      const int column = columns.injected[l][static_cast<std::size_t>(c)];
      const double value = column < 0 ? 0 : trace->at(k, column);
      effects.injected(c, link) = std::isfinite(value) ? value : 0;
      if (columns.link_state[l] < 0 && effects.injected(c, link) != 0) effects.state[l] = LinkState::fdi;
    }
    effects.strength[link] = kMissing;
    effects.playback[l] = {};
    const double source = columns.source[l] < 0 ? kMissing : trace->at(k, columns.source[l]);
    if (source >= 0 && source < static_cast<double>(k)) {
      const auto tick = static_cast<std::int64_t>(source);
      effects.playback[l] = {tick, tick, tick};
    }
  }
}

void Run::State::publish_world() {
  auto* values = frame.values.data();
  for (Eigen::Index c = 0; c < shared.truth.size(); ++c) values[slots.truth + c] = shared.truth[c];
  if (k > 0 || base.centre() >= 0) publish_links();
  if (k == 0 && world.continuous() == nullptr) return;
  for (Eigen::Index c = 0; c < shared.input.size(); ++c) values[slots.input + c] = shared.input[c];
  publish_sensors(shared, sensor_effects, values + slots.sensor);
  if (k == 0) return;
  for (std::size_t d = 0; d < slots.drives.size(); ++d) {
    if (slots.drives[d] >= 0) values[slots.drives[d]] = shared.drives[static_cast<Eigen::Index>(d)];
  }
}

void Run::State::publish_links() {
  auto* values = frame.values.data();
  for (std::size_t l = 0; l < slots.link.size(); ++l) {
    const int slot = slots.link[l];
    const auto link = static_cast<Eigen::Index>(l);
    values[slot] = static_cast<double>(effects.state[l]);
    const Eigen::Index n = effects.injected.rows();
    for (Eigen::Index c = 0; c < n; ++c) values[slot + 1 + c] = effects.injected(c, link);
    values[slot + 1 + n] = effects.strength[link];
    const std::int64_t source = effects.playback[l].source;
    if (source >= 0) values[slot + 2 + n] = static_cast<double>(source);
    values[slot + 3 + n] = effects.overheard[l];
  }
}

}  // namespace vigil
