/// Basis pursuit: argmin ||e||_1 subject to D e = b. Seed 001, section 4; specification, section 10.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>
#include <vector>

namespace vigil {

/// Mehrotra's predictor-corrector on e = u - v, u, v >= 0; where that stalls, simplex steps finish from its last
/// iterate, so that what is returned is the optimum or a plain failure. D has full row rank. Buffers are made once;
/// solving allocates nothing.
class BasisPursuit {
 public:
  BasisPursuit() = default;
  BasisPursuit(int rows, int columns, int max_iterations = 60);

  /// False where D has no full row rank or neither stage reaches the optimum; entries() is zero then.
  bool solve(const Eigen::Ref<const Eigen::MatrixXd>& D, const Eigen::Ref<const Eigen::VectorXd>& b);

  const Eigen::VectorXd& entries() const { return entries_; }
  bool finished_by_simplex() const { return by_simplex_; }
  int iterations() const { return iterations_; }

 private:
  bool interior_point(const Eigen::Ref<const Eigen::MatrixXd>& D, const Eigen::Ref<const Eigen::VectorXd>& b);
  bool newton(const Eigen::Ref<const Eigen::MatrixXd>& D, const Eigen::VectorXd& corrector);
  bool simplex(const Eigen::Ref<const Eigen::MatrixXd>& D, const Eigen::Ref<const Eigen::VectorXd>& b);
  bool choose_basis(const Eigen::Ref<const Eigen::MatrixXd>& D);

  Eigen::VectorXd entries_;
  Eigen::VectorXd z_, s_, y_, dz_, ds_, dy_, rp_, rd_, weight_, right_, corrector_, scratch_;
  Eigen::MatrixXd normal_, scaled_;
  Eigen::LLT<Eigen::MatrixXd> cholesky_;
  Eigen::MatrixXd basis_matrix_, reduced_;
  Eigen::PartialPivLU<Eigen::MatrixXd> lu_;
  Eigen::VectorXd basic_, dual_, direction_, sign_;
  std::vector<int> basis_, order_;
  std::vector<char> in_basis_;
  bool by_simplex_ = false;
  int iterations_ = 0;
  int max_iterations_ = 0;
};

}  // namespace vigil
