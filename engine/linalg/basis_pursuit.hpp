/// Basis pursuit: argmin ||e||_1 subject to D e = b. Seed 001, section 4; specification, section 10.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "engine/linalg/l1_simplex.hpp"

namespace vigil {

/// Mehrotra's predictor-corrector on e = u - v, u, v >= 0; where it stalls, simplex steps finish from its last iterate.
/// What is returned has passed a duality certificate, so it is the optimum within 1e-7 of ||e||_1, or it is a plain
/// failure. Where the optimum is not unique either stage may return another one. Rows are brought to unit length and b
/// to unit size first: no scale of D or b matters. Buffers are made once; solving allocates nothing.
class BasisPursuit {
 public:
  BasisPursuit() = default;
  /// max_iterations: of the interior point; with 0 simplex steps do it all, from the least-squares solution.
  BasisPursuit(int rows, int columns, int max_iterations = 60);

  /// D: rows x columns, its rows independent (to 1e-6 of each row's length); b: rows. False where they are not, an
  /// input is not finite or of another size, or neither stage reaches the optimum; entries are zero then.
  bool solve(const Eigen::Ref<const Eigen::MatrixXd>& D, const Eigen::Ref<const Eigen::VectorXd>& b);

  const Eigen::VectorXd& entries() const { return entries_; }
  const Eigen::VectorXd& dual() const { return dual_; }  ///< |D' dual| <= 1 and b' dual within 1e-7 of ||e||_1
  bool finished_by_simplex() const { return by_simplex_; }
  int iterations() const { return iterations_; }  ///< of the interior point

 private:
  bool normalise(const Eigen::Ref<const Eigen::MatrixXd>& D, const Eigen::Ref<const Eigen::VectorXd>& b);
  bool interior_point();
  void start();
  bool converged();
  bool factorise();
  bool newton();
  bool advance();
  bool take_iterate();
  bool certified();
  bool fail();

  Eigen::VectorXd entries_, dual_;
  // The problem in unit size: rows_ e = right_, e = entries / size_; gram_ factors rows_ rows_'.
  Eigen::MatrixXd rows_;
  Eigen::VectorXd lengths_, right_, least_squares_;
  Eigen::LLT<Eigen::MatrixXd> gram_{Eigen::MatrixXd::Identity(1, 1)};  ///< one that never was made must not be copied
  double size_ = 0;
  // The iterate: z = [u v], slacks s, multipliers y; a step of each; the residuals of D z = b, of the dual, of z s =
  // mu.
  Eigen::VectorXd z_, s_, y_, dz_, ds_, dy_, primal_, dual_gap_, complementarity_;
  Eigen::VectorXd ratio_;  ///< z / s
  Eigen::VectorXd column_scratch_, row_scratch_;
  Eigen::MatrixXd weighted_, normal_;
  Eigen::LLT<Eigen::MatrixXd> cholesky_{Eigen::MatrixXd::Identity(1, 1)};
  L1Simplex simplex_;
  int max_iterations_ = 0, iterations_ = 0;
  bool by_simplex_ = false;
};

}  // namespace vigil
