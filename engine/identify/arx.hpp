/// A linear model of recorded rows: y(k) = A_1 y(k-1) + … + A_p y(k-p) + B u(k-lag) + c + e(k), by least squares with
/// known inputs. Ljung, "System Identification", 2nd edition, section 4.2 (ARX).
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace vigil::identify {

/// What was recorded, one row a tick, NaN where a cell was empty.
struct Records {
  Eigen::MatrixXd outputs;              ///< rows x outputs
  Eigen::MatrixXd inputs;               ///< rows x inputs, which may be none
  std::vector<std::string> names = {};  ///< of the outputs, for messages; may be empty
  /// output "L_T1", or output 1 where it has no name.
  std::string output(Eigen::Index place) const;
};

struct Arx {
  int lag = 0;                     ///< 0: the input of row k acted up to row k; 1: from row k on
  std::vector<Eigen::MatrixXd> A;  ///< outputs x outputs, one a lag, newest first
  Eigen::MatrixXd B;               ///< outputs x inputs
  Eigen::VectorXd c;               ///< outputs
  double ridge = 0;                ///< see Regression
  double fitted_radius = 0;        ///< spectral radius of the autonomous part as least squares has it
  double radius = 0;               ///< as it is here
  double loss = 1;                 ///< mean square of the residuals over what it was before the projection; 1: none

  int order() const { return static_cast<int>(A.size()); }
};

/// The largest radius that a model may have: beyond it, it is projected.
inline constexpr double kLargestRadius = 1 - 1e-3;
/// The largest `loss` of a projection; a model that pays more is refused.
inline constexpr double kLargestLoss = 1.25;

/// Fits rows `from` to `to` - 1, leaving out those with a cell missing, and makes the autonomous part stable: A_i is
/// multiplied by g^i, which multiplies every pole by g and keeps the shape of lags, and B and c are fitted anew. Throws
/// InputError where there are fewer than three complete rows a weight, an output never changes, or the projection costs
/// more than kLargestLoss: the plant grows, and no stable model of that order says so.
Arx fit(const Records& records, Eigen::Index from, Eigen::Index to, int order, int lag);

/// Of the autonomous part: the largest modulus of the roots of det(z^p I - z^(p-1) A_1 - … - A_p). At least one lag.
double spectral_radius(const std::vector<Eigen::MatrixXd>& A);

/// The autonomous part with the last `order` outputs as its state, newest first.
Eigen::MatrixXd companion(const std::vector<Eigen::MatrixXd>& A);

/// e(k) of every row, rows x outputs; NaN where something it needs is missing.
Eigen::MatrixXd residuals(const Arx& model, const Records& records);

/// The model alone from row `from` on, started from the recorded rows before it (the first place where they are
/// complete) and driven by the recorded inputs, a missing one held: root mean square error of each output, infinite
/// where it leaves every range. NaN where it can start nowhere.
Eigen::VectorXd free_run_error(const Arx& model, const Records& records, Eigen::Index from);

}  // namespace vigil::identify
