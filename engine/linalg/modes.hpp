/// Modes of a linear system, and which of them its outputs do not show or its inputs do not move.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <optional>
#include <vector>

namespace vigil {

/// Of x+ = A x, or of x' = A x.
enum class TimeKind { ticks, continuous };
enum class Fate { decays, stays, grows };

/// An eigenvalue with its conjugate and its repeats.
struct Mode {
  std::complex<double> value;  ///< imaginary part >= 0
  int count = 1;               ///< eigenvalues that it stands for: a conjugate pair is two
};

/// What decides whether it decays: the modulus in ticks, the real part in continuous time.
double size_of(const Mode& mode, TimeKind time);

/// The modes of a matrix and what becomes of each, against that matrix' own size: to 1e-8 of modulus 1 in ticks, of
/// real part 0 (times the Frobenius norm of A) in continuous time, a mode stays.
class Modes {
 public:
  /// A: n x n, n >= 1. Nothing where A is not finite or its eigenvalues are not found.
  static std::optional<Modes> of(const Eigen::MatrixXd& A, TimeKind time);

  const std::vector<Mode>& all() const { return all_; }  ///< the largest first
  Fate fate(const Mode& mode) const;
  bool stable() const;  ///< every one decays

 private:
  TimeKind time_ = TimeKind::ticks;
  double norm_ = 1;
  std::vector<Mode> all_;
};

inline constexpr double kHidden = 1e-10;

/// What outputs y = C x show of x+ = A x or x' = A x. Popov, Belevitch and Hautus: a mode is hidden where the least
/// singular value of [A - mode I; C] is at most kHidden, A divided by its Frobenius norm and every row of C by its
/// length. Repeated modes are counted by the largest A-invariant subspace that C does not show.
struct Visibility {
  int rank = 0;              ///< dimension of what is seen: states less hidden ones
  std::vector<Mode> hidden;  ///< the largest first
  Mode weakest;              ///< the mode that is seen worst
  double margin = 0;         ///< its least singular value, 0 to about 1
};

/// A: n x n, n >= 1, C: p x n, p >= 0. Nothing where one is not finite or eigenvalues are not found.
std::optional<Visibility> visibility(const Eigen::MatrixXd& A, const Eigen::MatrixXd& C, TimeKind time);

}  // namespace vigil
