/// The zonotope filter's gains and sets, which depend on no reading. Seed 003, reference [26], as the specification
/// (replay), section 8.2, reconstructs it.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "engine/linalg/small.hpp"

namespace vigil::replay {

/// Steps k = 1, 2, ... on line. Value semantics; memory is taken when made, a step allocates nothing.
class ZonotopeSchedule {
 public:
  /// A: n x n, C: p x n, Mw: n x n, Mv: p x p; order: generators kept, at least n. The boxes are tight around the
  /// ellipsoids; H_0 is the process's. Nothing where an innovation matrix C Pz C' + Hv Hv' of the first `steps` steps
  /// is not invertible. steps: after which the watermark's size is taken (the last of the horizon).
  static std::optional<ZonotopeSchedule> make(const Eigen::MatrixXd& A, const Eigen::MatrixXd& C,
                                              const Eigen::MatrixXd& Mw, const Eigen::MatrixXd& Mv, int order,
                                              int steps = 300);

  /// The next step's K, Z and, after the update, H. False where its innovation matrix is not invertible: nothing moved.
  bool advance();
  /// A step whose reading is missing: H is the prediction's, K and Z are still those of the step.
  bool advance_unheard();

  using Generators = Eigen::Ref<const Eigen::MatrixXd>;
  const BoundedMatrix& K() const { return K_; }  ///< n x p
  /// Generators of the innovations a healthy loop can have, p x any, and of the estimate's error, n x at most order.
  Generators Z() const { return Z_.leftCols(healthy_); }
  Generators H() const { return H_.leftCols(generators_); }
  const Eigen::VectorXd& half_widths() const { return half_widths_; }  ///< h: of Z at the last of `steps`; p

 private:
  ZonotopeSchedule() = default;
  bool predict();
  BoundedMatrix A_, C_, Hw_, Hv_;
  int order_ = 20;
  // As wide as they can become; the counts say how many columns hold. predicted_: [A H, Hw], n; corrected_: after the
  // update, before the reduction.
  Eigen::MatrixXd H_, Z_, predicted_, corrected_;
  Eigen::Index generators_ = 0, healthy_ = 0;
  std::vector<Eigen::Index> places_;
  BoundedMatrix K_;
  Eigen::VectorXd half_widths_;
};

}  // namespace vigil::replay
