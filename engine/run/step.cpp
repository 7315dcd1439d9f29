/// One tick, in the order of the design.
#include <cmath>
#include <limits>

#include "engine/run/state.hpp"

namespace vigil {
namespace {
constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
}

void Run::State::step(Sink& sink) {
  ++k;
  if (k > 0) {
    while (!pending.empty() && pending.front().k <= k) {
      const Command command = pending.front();
      pending.erase(pending.begin());
      change(command, &sink);
    }
    advance_world();
    sense();
    effects.clear();
    sensor_effects.clear();
    adversary.act(k, effects, sensor_effects, sink);
    if (trace) override_links();
    deliver_readings();
    if (trace) override_sensors();
    for (Lane& lane : lanes) lane.tick(k, graph, base_of, effects, input, lane.spared() ? readings : received);
  }
  std::fill(frame.values.begin(), frame.values.end(), kMissing);
  frame.k = k;
  frame.t = static_cast<double>(k) * dt;
  publish_world();
  for (Lane& lane : lanes) {
    lane.publish(k, truth, lane.spared() ? no_sensor_effects : sensor_effects, *plant, frame.values);
    lane.faults().mark_edges(lane.id(), lane.outputs(), sink);
  }
  // A plant may overflow (a document can ask for 1e300): a frame says that as missing, never as infinity.
  for (double& value : frame.values) value = std::isfinite(value) ? value : kMissing;
  sink.frame(frame);
}

void Run::State::advance_world() {
  if (trace) {
    for (std::size_t c = 0; c < columns.input.size(); ++c) {
      const double value = trace->at(k, columns.input[c]);
      if (std::isfinite(value))
        input[static_cast<Eigen::Index>(c)] = value;  // a missing input holds the last one, or is none
      if (!std::isfinite(input[static_cast<Eigen::Index>(c)])) input[static_cast<Eigen::Index>(c)] = 0;
    }
    for (Eigen::Index c = 0; c < truth.size(); ++c) {
      const int column = columns.truth[static_cast<std::size_t>(c)];
      truth[c] = column < 0 ? kMissing : trace->at(k, column);
    }
    return;
  }
  process_noise.normals(k, noise);
  plant->advance(truth, input, next_truth);
  truth = next_truth;
  truth.noalias() += Q_root * noise;
}

void Run::State::sense() {
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    Eigen::VectorXd& z = readings[i];
    if (trace) {
      for (Eigen::Index c = 0; c < z.size(); ++c) {
        const int column = columns.sensor[i][static_cast<std::size_t>(c)];
        z[c] = column < 0 ? kMissing : trace->at(k, column);
      }
      continue;
    }
    sensors[i]->measure(truth, z);
    for (Eigen::Index r = 0; r < z.size(); ++r) {
      for (Eigen::Index c = 0; c < z.size(); ++c)
        z[r] += R_root[i](r, c) * sensor_noise[i].normal(k, static_cast<std::uint32_t>(c));
    }
  }
}

/// What arrives: the adversary adds, and angles are wrapped after that.
void Run::State::deliver_readings() {
  for (std::size_t i = 0; i < readings.size(); ++i) {
    received[i] = readings[i];
    if (sensor_effects.state[i] == SensorState::clean) continue;
    for (Eigen::Index c = 0; c < received[i].size(); ++c) {
      const double period = sensors[i]->channels()[static_cast<std::size_t>(c)].period;
      received[i][c] = wrap(readings[i][c] + sensor_effects.injected[i][c], period);
    }
  }
}

/// A sensor whose `injected` or `state` columns the trace has bypasses the adversary: the reading is there as received,
/// and beside it the honest one.
void Run::State::override_sensors() {
  const auto read = [&](int column) { return column < 0 ? kMissing : trace->at(k, column); };
  for (std::size_t i = 0; i < readings.size(); ++i) {
    bool described = columns.sensor_state[i] >= 0;
    for (const int column : columns.tampered[i]) described = described || column >= 0;
    if (!described) continue;
    bool tampered = false;
    for (Eigen::Index c = 0; c < readings[i].size(); ++c) {
      const auto channel = static_cast<std::size_t>(c);
      const double added = read(columns.tampered[i][channel]), honest = read(columns.sent[i][channel]);
      received[i][c] = read(columns.sensor[i][channel]);
      readings[i][c] = std::isfinite(honest) ? honest : received[i][c];
      sensor_effects.injected[i][c] = std::isfinite(added) ? added : 0;
      tampered = tampered || sensor_effects.injected[i][c] != 0;
    }
    const double state = read(columns.sensor_state[i]);
    sensor_effects.state[i] = tampered ? SensorState::fdi : SensorState::clean;
    if (std::isfinite(state)) sensor_effects.state[i] = static_cast<SensorState>(static_cast<int>(state));
  }
}

/// Channels that the trace describes bypass the adversary.
void Run::State::override_links() {
  for (std::size_t l = 0; l < columns.link_state.size(); ++l) {
    const auto link = static_cast<Eigen::Index>(l);
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
  }
}

void Run::State::publish_world() {
  auto* values = frame.values.data();
  for (Eigen::Index c = 0; c < truth.size(); ++c) values[slots.truth + c] = truth[c];
  if (k == 0) return;
  for (Eigen::Index c = 0; c < input.size(); ++c) values[slots.input + c] = input[c];
  for (std::size_t i = 0; i < readings.size(); ++i) {
    values[slots.sensor[i]] = static_cast<double>(sensor_effects.state[i]);
    for (Eigen::Index c = 0; c < readings[i].size(); ++c) {
      double* at = values + slots.sensor[i] + 1 + 3 * c;
      at[0] = received[i][c];
      if (readings[i][c] != received[i][c]) at[1] = readings[i][c];
      at[2] = sensor_effects.injected[i][c];
    }
  }
  for (std::size_t l = 0; l < slots.link.size(); ++l) {
    const int slot = slots.link[l];
    const auto link = static_cast<Eigen::Index>(l);
    values[slot] = static_cast<double>(effects.state[l]);
    const Eigen::Index n = effects.injected.rows();
    for (Eigen::Index c = 0; c < n; ++c) values[slot + 1 + c] = effects.injected(c, link);
    values[slot + 1 + n] = effects.strength[link];
  }
}

}  // namespace vigil
