/// The course of one plant: where it is, what its sensors say. Lanes share one where they can; a lane that controls has
/// one of its own, driven by the same draws.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "engine/methods/method.hpp"
#include "engine/world/continuous.hpp"
#include "engine/world/controller.hpp"
#include "engine/world/drive.hpp"
#include "engine/world/noise.hpp"
#include "engine/world/plant.hpp"
#include "engine/world/plant_flow.hpp"
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

  const ContinuousPlant* continuous() const { return plant->continuous(); }
  double dt = 1;              ///< s, a tick
  Drive drive;                ///< of a plant in continuous time
  ActuatorEffects actuators;  ///< this tick's
};

struct Course {
  Eigen::VectorXd truth;
  Eigen::VectorXd input;     ///< what acted from the last tick to this one
  Eigen::VectorXd upcoming;  ///< what acts from this tick to the next
  Eigen::VectorXd past;      ///< the truth a tick ago; of continuous time only
  Eigen::VectorXd drives;    ///< all that drives it at this tick, by the plant's ports; of continuous time only
  Readings readings;         ///< as the sensors measure
  Readings sent;             ///< as they leave the sensors, with what a sensor side adds
  Readings received;         ///< as they arrive

  Course() = default;
  explicit Course(const World& world);
  /// x <- f(x, u) + w with the upcoming input. In continuous time: along the flow of tick k, attacked or not.
  void advance(const World& world, std::int64_t k, bool attacked);
  void sense(const World& world);
  /// Tick 0 of continuous time: what drives it and what is read, without noise.
  void begin_flow(const World& world);

 private:
  void note_inputs(const ContinuousPlant& plant);

  Eigen::VectorXd next_, outputs_;
  PlantFlow flow_;
};

}  // namespace vigil
