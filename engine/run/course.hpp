/// The course of one plant: where it is, what its sensors say. Lanes share one where they can; a lane that controls has
/// one of its own, driven by the same draws.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "engine/methods/method.hpp"
#include "engine/world/controller.hpp"
#include "engine/world/noise.hpp"
#include "engine/world/plant.hpp"
#include "engine/world/sensor.hpp"

namespace vigil {

/// What every course of a run has in common.
struct World {
  std::shared_ptr<const Plant> plant;
  std::vector<std::shared_ptr<const Sensor>> sensors;
  std::shared_ptr<const Controller> controller;  ///< null: nothing drives the plant but a recorded input
  NoiseSource process_noise;
  std::vector<NoiseSource> sensor_noise;

  Eigen::VectorXd process;  ///< this tick's process noise
  Readings sensing;         ///< this tick's sensor noise, one a node
  void draw(std::int64_t k);
};

struct Course {
  Eigen::VectorXd truth;
  Eigen::VectorXd input;     ///< what acted from the last tick to this one
  Eigen::VectorXd upcoming;  ///< what acts from this tick to the next
  Readings readings;         ///< as the sensors measure
  Readings sent;             ///< as they leave the sensors, with what a sensor side adds
  Readings received;         ///< as they arrive

  Course() = default;
  explicit Course(const World& world);
  /// x <- f(x, u) + w with the upcoming input.
  void advance(const World& world);
  void sense(const World& world);

 private:
  Eigen::VectorXd next_;
};

}  // namespace vigil
