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
  Eigen::MatrixXd process_covariance;  ///< of both its parts together, as an adversary's filter takes it
  std::vector<NoiseSource> sensor_noise;

  Eigen::VectorXd process;  ///< this tick's process noise
  Readings sensing;         ///< this tick's sensor noise, one a node
  void draw(std::int64_t k);

  const ContinuousPlant* continuous() const { return plant->continuous(); }
  double dt = 1;              ///< s, a tick
  Drive drive;                ///< of a plant in continuous time
  ActuatorEffects actuators;  ///< this tick's
  /// Discrete time: what becomes of the command u on its way to the actuators; `applied` has what reached them a tick
  /// ago and gets what reaches them now. inputs: both of them. No allocation.
  void command(const Eigen::VectorXd& u, Eigen::VectorXd& applied) const;
};

struct Course {
  Eigen::VectorXd truth;
  Eigen::VectorXd input;     ///< what acted from the last tick to this one
  Eigen::VectorXd upcoming;  ///< what acts from this tick to the next
  Eigen::VectorXd past;      ///< the truth a tick ago; of continuous time only
  /// All that drives it at this tick, by the plant's ports; in discrete time what the adversary added to a controller's
  /// input, from the last tick to this one.
  Eigen::VectorXd drives;
  Readings readings;  ///< as the sensors measure
  Readings sent;      ///< as they leave the sensors, with what a sensor side adds
  Readings received;  ///< as they arrive
  Readings injected;  ///< what the adversary added to them, after any playback

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
  Eigen::VectorXd applied_;  ///< the input that reached the plant; of discrete time only
  PlantFlow flow_;
};

}  // namespace vigil
