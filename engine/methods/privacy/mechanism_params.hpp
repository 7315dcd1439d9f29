/// What the mechanisms of differential privacy declare and show alike. Specification (privacy), sections 1.6 and 3.1.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "engine/core/params.hpp"
#include "engine/methods/privacy/dp_fusion.hpp"
#include "engine/methods/privacy/protection.hpp"

namespace vigil::privacy {

Param epsilon_param();
Param delta_param();
Param adjacent_param();  ///< H: the components in which two adjacent trajectories may differ; null: in all
/// H as n entries. Throws InputError at /H where it is not n zeros and ones.
Eigen::VectorXd read_adjacent(const Params& params, int n);

/// epsilon, delta, lambda, kappa and H, which both mechanisms of section 3 declare, then those of its own.
ParamTable dp_table(std::vector<Param> own);
/// Of those; `shares` is left empty. Throws InputError at /H.
DpSettings read_dp_settings(const Params& params, int n);

/// True where the local filters are in their stationary law in this tick, to 1e-9.
bool stationary(const PublicTick& tick, const StationaryFilters& filters);

/// Appends to "releases" of a design how two neighbouring outputs of a node differ, by component: {node, component,
/// std, shift}. std, shift: of each state.
void add_releases(Json& design, const std::string& node, const Plant& plant, const Eigen::VectorXd& std,
                  const Eigen::VectorXd& shift);
/// The same of the distance of outputs whose components all have that noise.
void add_distance(Json& design, const std::string& node, double std, const Eigen::VectorXd& shift);

/// [[..],..], as a design has it.
Json matrix_json(const Eigen::MatrixXd& matrix);

}  // namespace vigil::privacy
