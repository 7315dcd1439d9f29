#include "engine/run/course.hpp"

#include <algorithm>
#include <utility>

#include "engine/core/missing.hpp"
#include "engine/linalg/small.hpp"

namespace vigil {
void World::draw(std::int64_t k) {
  process_noise.draw(k, process);
  for (std::size_t i = 0; i < sensors.size(); ++i) sensor_noise[i].draw(k, sensing[i]);
}

void World::command(const Eigen::VectorXd& u, Eigen::VectorXd& applied) const {
  const auto entries = [&](const ActuatorPlace& place) {
    return std::pair<Eigen::Index, Eigen::Index>(std::max(place.channel, 0), place.channel < 0 ? u.size() : 1);
  };
  BoundedVector arrives = u;
  for (const ActuatorEffects::Push& push : actuators.pushes) {
    const auto [first, count] = entries(push.place);
    const double t = static_cast<double>(push.k) * dt;
    push.attack->push(push, t, t, arrives.segment(first, count));
  }
  for (const ActuatorEffects::Stop& stop : actuators.stops) {
    const auto [first, count] = entries(stop.place);
    if (stop.held) {
      arrives.segment(first, count) = applied.segment(first, count);
    } else {
      arrives.segment(first, count).setZero();
    }
  }
  applied = arrives;
}

Course::Course(const World& world)
    : truth(Eigen::VectorXd::Zero(world.plant->states())),
      input(Eigen::VectorXd::Constant(world.plant->inputs(), kMissing)),
      upcoming(input),
      past(truth),
      next_(truth) {
  for (const auto& sensor : world.sensors) readings.emplace_back(Eigen::VectorXd::Constant(sensor->size(), kMissing));
  if (world.controller == nullptr && world.plant->linear()) upcoming.setZero();  // nobody drives it
  sent = readings;
  received = readings;
  for (const auto& sensor : world.sensors) injected.emplace_back(Eigen::VectorXd::Zero(sensor->size()));
  applied_ = Eigen::VectorXd::Zero(world.plant->inputs());
  if (world.controller != nullptr) drives = applied_;
  if (const ContinuousPlant* plant = world.continuous()) {
    drives = Eigen::VectorXd::Zero(plant->drives());
    outputs_ = Eigen::VectorXd::Zero(plant->outputs());
    flow_ = PlantFlow(*plant, world.dt);
  }
}

void Course::advance(const World& world, std::int64_t k, bool attacked) {
  if (const ContinuousPlant* plant = world.continuous()) {
    const ActuatorEffects* pushes = attacked ? &world.actuators : nullptr;
    past = truth;
    flow_.advance(*plant, world.drive, pushes, k, truth);
    truth += world.process;
    const double t = static_cast<double>(k) * world.dt;
    world.drive.read(t, t, pushes, drives);
    note_inputs(*plant);
    return;
  }
  input = upcoming;
  if (attacked && !world.actuators.idle()) {
    world.command(input, applied_);
    drives = applied_ - input;
  } else {
    applied_ = input;
    drives.setZero();
  }
  world.plant->advance(truth, applied_, next_);
  truth = next_ + world.process;
}

/// What acts at this tick of the known inputs is what is written down of them.
void Course::note_inputs(const ContinuousPlant& plant) {
  Eigen::Index entry = 0;
  for (const DrivePorts& ports : plant.ports()) {
    for (int c = 0; c < ports.u; ++c) input[entry++] = drives[ports.first + c];
  }
}

void Course::begin_flow(const World& world) {
  world.drive.read(0, 0, nullptr, drives);
  note_inputs(*world.continuous());
  past = truth;
  sense(world);
  sent = readings;
  received = readings;
}

void Course::sense(const World& world) {
  const ContinuousPlant* plant = world.continuous();
  if (plant != nullptr) plant->output(truth, drives, outputs_);
  Eigen::Index output = 0;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    if (plant != nullptr) {
      readings[i] = outputs_.segment(output, readings[i].size());
      output += readings[i].size();
    } else {
      world.sensors[i]->measure(truth, readings[i]);
    }
    readings[i] += world.sensing[i];
    const auto& channels = world.sensors[i]->channels();
    for (std::size_t c = 0; c < channels.size(); ++c) {
      double& reading = readings[i][static_cast<Eigen::Index>(c)];
      if (channels[c].period > 0) reading = wrap(reading, channels[c].period);
    }
  }
}

}  // namespace vigil
