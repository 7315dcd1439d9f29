/// Primal simplex for min ||e||_1 subject to D e = b, from a guess. Specification, section 10: what finishes a stalled
/// interior point.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <vector>

namespace vigil {

/// The linear program in e = u - v, u, v >= 0 without its second half: a basis holds as many columns as D has rows,
/// each with the sign of its entry; all other entries are zero. Buffers are made once; solving allocates nothing.
class L1Simplex {
 public:
  L1Simplex() = default;
  L1Simplex(int rows, int columns);

  /// D: rows x columns, its rows independent and of about unit length; b: rows. Starts at the independent columns whose
  /// |guess| (columns) is largest. False where the rows are dependent or after 100 pivots a row; entries are zero then.
  bool solve(const Eigen::Ref<const Eigen::MatrixXd>& D, const Eigen::Ref<const Eigen::VectorXd>& b,
             const Eigen::Ref<const Eigen::VectorXd>& guess);

  const Eigen::VectorXd& entries() const { return entries_; }  ///< the optimum, exactly zero off its basis
  const Eigen::VectorXd& dual() const { return dual_; }        ///< rows; |D' dual| <= 1 + 1e-9, b' dual = ||e||_1
  int pivots() const { return pivots_; }

 private:
  bool choose_basis(const Eigen::Ref<const Eigen::MatrixXd>& D, const Eigen::Ref<const Eigen::VectorXd>& guess);
  bool evaluate(const Eigen::Ref<const Eigen::MatrixXd>& D, const Eigen::Ref<const Eigen::VectorXd>& b);
  int entering(const Eigen::Ref<const Eigen::MatrixXd>& D, bool bland);
  Eigen::Index leaving(bool bland);
  int variable(Eigen::Index position) const;

  Eigen::VectorXd entries_, dual_;
  Eigen::MatrixXd basis_matrix_;
  Eigen::MatrixXd orthonormal_;  ///< of the columns chosen so far, while the first basis is looked for
  Eigen::PartialPivLU<Eigen::MatrixXd> lu_;
  Eigen::VectorXd basic_;      ///< the entries of the basis
  Eigen::VectorXd sign_;       ///< +1 where u is the basic variable, -1 where v is
  Eigen::VectorXd direction_;  ///< by how much the basic entries fall a unit of the entering one
  Eigen::VectorXd price_, scratch_;
  std::vector<int> basis_, order_;
  std::vector<char> in_basis_;
  int pivots_ = 0;
  double step_ = 0;  ///< of the pivot under way
};

}  // namespace vigil
