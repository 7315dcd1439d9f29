/// Windows of readings made at random, and the regression they give by plain dense algebra. Specification of seed 001,
/// section 7.
#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "engine/methods/sparse/reconstructor.hpp"
#include "tests/engine/methods/rig.hpp"

namespace vigil::windows {

enum class Tampering { none, random, constant };  ///< of range and azimuth: types I and II of the source

std::shared_ptr<const Plant> tracker();

std::shared_ptr<const Sensor> station(const Json& position, const Json& R = 1e-4);

Eigen::MatrixXd loop();

/// T readings of a target on its way, with the priors a filter had at them.
struct Scene {
  std::shared_ptr<const Sensor> sensor;
  int T;
  Eigen::MatrixXd readings;  ///< p x T, oldest first
  Eigen::MatrixXd met;       ///< n x T
  Eigen::VectorXd prior;     ///< at the newest reading
};

Eigen::VectorXd normals(std::uint64_t trial, const char* what, std::int64_t k, int size);

/// Somewhere on the way, another place in each trial.
Scene scene(std::shared_ptr<const Sensor> sensor, std::uint64_t trial, int T, Tampering tampering);

/// The same scene in the window that is under test.
sparse::Regression regress(const Scene& s, sparse::Linearisation where = sparse::Linearisation::prior,
                           bool as_printed = false);

/// What section 7 says, with a dense QR and an inverse, whitened by R = L L'.
struct Plain {
  Eigen::VectorXd r;
  Eigen::MatrixXd Phi, W, M;  ///< W: blocks L^-1; M = I - Q1 Q1' of W Phi
};

double turned(double angle);

Eigen::MatrixXd derivative(const Sensor& sensor, const Eigen::VectorXd& x, bool as_printed);

Plain plain(const Scene& s, sparse::Linearisation where = sparse::Linearisation::prior, bool as_printed = false);

/// Readings of a coloured noise: range and azimuth go together, elevation is worse than the velocities.
Json coloured();

}  // namespace vigil::windows
