/// Differential privacy of a published mean of fused estimates, its noise put in at the sensors or at the centre. Seed
/// 004, (3-10)-(3-33), with the corrections of the specification (privacy), section 3.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/methods/privacy/lmv_fusion.hpp"
#include "engine/methods/privacy/local_filters.hpp"

namespace vigil::privacy {

struct DpSettings {
  double epsilon = 0.69314718055994531;  ///< > 0; ln 2
  double delta = 0.1;                    ///< between 0 and 1/2
  double lambda = 1;                     ///< >= 0, how far two adjacent states are apart (2-norm)
  int kappa = 10;                        ///< >= 1, fused estimates in a published mean
  Eigen::VectorXd H;                     ///< n entries 0 or 1: the components that may differ
  std::vector<double> shares;            ///< of the noise, one a sensor, >= 0, of sum 1; empty: all alike
  bool at_centre = false;                ///< no sensor adds any, whatever the shares: the centre does
};

struct DpFusion {
  StationaryFilters filters;
  Fusion nominal;
  std::vector<Eigen::MatrixXd> KCH;  ///< K_i C_i H, n x n
  double gamma = 0, sigma = 0;       ///< sigma = || W KC H ||
  double q_centre = 0;               ///< variance at the centre as printed, (gamma sigma lambda)^2
  double q_centre_enough = 0;        ///< the same over kappa^2: enough for the mean
  double q_total = 0;                ///< variance of all sensors together, over kappa
  std::vector<double> q;             ///< of each sensor
  std::vector<double> condition;     ///< of W_i; infinite where it is singular
  std::vector<Eigen::MatrixXd> G;    ///< W_i^-1, zero for a sensor without noise
  Eigen::MatrixXd Pc;                ///< of what the sensors send, (n L) x (n L)
  Fusion compensated;                ///< the legitimate user's
  Eigen::MatrixXd public_P;          ///< of what an eavesdropper fuses, n x n
};

/// Throws InputError where a setting is out of its range, a filter has no stationary law, or a sensor that is to add
/// noise has a W_i of condition 1e10 or more.
DpFusion design_dp_fusion(const FusionModel& model, const DpSettings& settings);

/// How far apart two adjacent trajectories look to each observer, as mu. Section 3.5.
struct DpViews {
  double mean = 0;        ///< one published mean, difference at the window's last instant (Theorem 3.2)
  double mean_worst = 0;  ///< the same at the worst lag
  int worst_lag = 0;
  double mean_difference = 0;  ///< two successive window means
  double instant = 0;          ///< the fused estimate of one instant
  double packets = 0;          ///< all packets of one instant, kept apart
  double fused_stream = 0;     ///< all fused estimates from then on
  double packet_stream = 0;    ///< all packets from then on
  double sustained = 0;        ///< one mean, trajectories apart by lambda at all times
};
DpViews dp_views(const DpFusion& design, const DpSettings& settings);

}  // namespace vigil::privacy
