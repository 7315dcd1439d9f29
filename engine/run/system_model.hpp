/// A scenario's world as matrices, for the report on it.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/linalg/modes.hpp"
#include "engine/scenario/scenario.hpp"
#include "engine/world/controller.hpp"
#include "engine/world/graph.hpp"
#include "engine/world/sensor.hpp"

namespace vigil {

/// Where the matrices come from: a tick's own; given in continuous time and held for a tick; of x' = A x + B u; of a
/// nonlinear plant, linearised at the initial truth.
enum class ModelKind { discrete, sampled, continuous, linearised };

struct SystemModel {
  std::shared_ptr<const Plant> plant;
  std::shared_ptr<const Controller> controller;  ///< null: none
  std::vector<std::string> nodes;
  std::vector<std::shared_ptr<const Sensor>> sensors;
  Graph graph;
  ModelKind kind = ModelKind::discrete;
  LinearModel model;
  std::optional<Eigen::MatrixXd> given_A;  ///< of a sampled plant: the A of x' = A x + B u
  std::vector<Eigen::MatrixXd> C;          ///< one a node, channels x states

  TimeKind time() const { return kind == ModelKind::continuous ? TimeKind::continuous : TimeKind::ticks; }
};

/// Throws InputError where the scenario's world cannot be made.
SystemModel system_model(const Scenario& scenario);

/// Every C, one below the other; states: of the plant.
Eigen::MatrixXd stacked(const std::vector<Eigen::MatrixXd>& C, int states);

}  // namespace vigil
