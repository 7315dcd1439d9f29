#include "engine/run/course.hpp"

#include <limits>

namespace vigil {
namespace {
constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
}

void World::draw(std::int64_t k) {
  process_noise.draw(k, process);
  for (std::size_t i = 0; i < sensors.size(); ++i) sensor_noise[i].draw(k, sensing[i]);
}

Course::Course(const World& world)
    : truth(Eigen::VectorXd::Zero(world.plant->states())),
      input(Eigen::VectorXd::Constant(world.plant->inputs(), kMissing)),
      upcoming(input),
      next_(truth) {
  for (const auto& sensor : world.sensors) readings.emplace_back(Eigen::VectorXd::Constant(sensor->size(), kMissing));
  sent = readings;
  received = readings;
}

void Course::advance(const World& world) {
  input = upcoming;
  world.plant->advance(truth, input, next_);
  truth = next_ + world.process;
}

void Course::sense(const World& world) {
  for (std::size_t i = 0; i < readings.size(); ++i) {
    world.sensors[i]->measure(truth, readings[i]);
    readings[i] += world.sensing[i];
    const auto& channels = world.sensors[i]->channels();
    for (std::size_t c = 0; c < channels.size(); ++c) {
      double& reading = readings[i][static_cast<Eigen::Index>(c)];
      if (channels[c].period > 0) reading = wrap(reading, channels[c].period);
    }
  }
}

}  // namespace vigil
