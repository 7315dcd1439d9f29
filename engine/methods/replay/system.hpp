/// What the methods of seed 003 know of the plant: a linear system with one sensor and two kinds of noise.
#pragma once

#include <Eigen/Core>
#include <string>

#include "engine/methods/method.hpp"

namespace vigil::replay {

/// x+ = A x + B u + d + w, y = C x + f + v: d, f random with covariances P, R; w, v in the ellipsoids Mw, Mv.
struct System {
  Eigen::MatrixXd A, B, C, P, R, Mw, Mv;
  int states() const { return static_cast<int>(A.rows()); }
  int channels() const { return static_cast<int>(C.rows()); }
};

/// Throws InputError where the plant or the sensor is not linear, there is more than one node, or a mode that does not
/// decay cannot be seen.
System read_system(const Knowledge& knowledge);

/// A matrix as a document or a design has it: [[..],..].
Json to_json(const Eigen::MatrixXd& matrix);
/// "C is [[..],..]" for a message.
std::string named(const char* name, const Eigen::MatrixXd& matrix);

}  // namespace vigil::replay
