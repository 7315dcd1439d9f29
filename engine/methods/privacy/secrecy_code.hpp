/// State-secrecy codes (Tsiamis, Gatsis and Pappas): a sensor sends its estimate less a multiple of its last one.
/// Specification (privacy), section 4.6.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "engine/methods/privacy/lmv_fusion.hpp"
#include "engine/methods/privacy/local_filters.hpp"

namespace vigil::privacy {

/// Code A (Lc = A): the covariance, in the long run, of what an eavesdropper fuses that misses each time step, all
/// sensors together, with probability `loss` (0..1) and predicts A xe then. Nothing where A is not stable.
std::optional<Eigen::MatrixXd> code_a_eavesdropper(const FusionModel& model, const StationaryFilters& filters,
                                                   const Fusion& nominal, double loss);

/// Code L, one a sensor: Lc = S_i A^-T S_i^-1, S_i the covariance of the sensor's estimate; what is sent is then
/// uncorrelated with the newest estimate. Nothing where A is not stable or not invertible. Its eavesdropper is left
/// with the prior: state_covariance.
std::optional<std::vector<Eigen::MatrixXd>> code_l(const FusionModel& model, const StationaryFilters& filters);

}  // namespace vigil::privacy
