/// Orthogonal matching pursuit: the sparse e with D e close to y, one column at a time. Seed 001, section 2, eq. (6);
/// specification, section 8.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace vigil {

/// Buffers are made once for a number of columns and a largest support. Picks the column with the largest
/// |d_j' residual| / ||d_j||, the lowest index on ties, and refits, until `picks` columns are chosen, the residual's
/// norm is at most `tolerance`, or no column is left that is independent of the chosen ones and explains more than
/// rounding (1e-13 ||y||). A column whose square, or what is left of it beside the chosen ones, is below 1e-12 of the
/// largest square says nothing and is passed over.
class Omp {
 public:
  Omp() = default;
  /// columns: of the dictionary. picks: the largest support any solve may ask for; more is cut to it.
  Omp(int columns, int picks);

  /// The Gram form: G = D' D (columns x columns, symmetric, positive semidefinite), b = D' y, norm_y = ||y||. Allocates
  /// nothing. The residual's norm is a difference of squares here, good to about 1e-8 ||y||. False where an input has
  /// another size or is not finite (of G: its diagonal and the chosen columns; the rest is not looked at): entries are
  /// zero then and the support is empty.
  bool solve_gram(const Eigen::Ref<const Eigen::MatrixXd>& G, const Eigen::Ref<const Eigen::VectorXd>& b, double norm_y,
                  int picks, double tolerance);
  /// The same on the dictionary itself, D (rows x columns) and y (rows). Allocates where the number of rows is new.
  bool solve(const Eigen::Ref<const Eigen::MatrixXd>& D, const Eigen::Ref<const Eigen::VectorXd>& y, int picks,
             double tolerance);

  const Eigen::VectorXd& entries() const { return entries_; }                   ///< e, exactly zero off the support
  std::span<const int> support() const { return {support_.data(), picked()}; }  ///< in the order picked
  double residual() const { return residual_; }                                 ///< ||y - D e||

 private:
  std::size_t picked() const { return static_cast<std::size_t>(count_); }
  bool begin(const Eigen::Ref<const Eigen::VectorXd>& squares, double norm_y);
  bool wants_more(int picks, double tolerance) const;
  int best_column();
  bool grow(int column, const Eigen::Ref<const Eigen::VectorXd>& of_gram);
  bool orthonormalise(const Eigen::Ref<const Eigen::VectorXd>& column);
  void join(int column);
  bool finish();
  bool fail();

  Eigen::VectorXd entries_;
  Eigen::VectorXd correlation_;  ///< D' residual
  Eigen::VectorXd per_norm_;     ///< 1 / ||d_j||, zero for a column that may not be picked (any more)
  Eigen::VectorXd gain_;
  Eigen::MatrixXd directions_;   ///< D' Q for the orthonormal basis Q of the chosen columns; columns x picks
  Eigen::MatrixXd factor_;       ///< R in Q R = the chosen columns, upper triangular; picks x picks
  Eigen::VectorXd shares_;       ///< Q' y
  Eigen::MatrixXd orthonormal_;  ///< Q itself, where the dictionary is explicit; rows x picks
  Eigen::VectorXd remainder_;    ///< y - D e, where the dictionary is explicit
  std::vector<int> support_;     ///< the first count_ hold; full size, so that a copy allocates nothing either
  Eigen::Index count_ = 0;
  double residual_ = 0;
  double least_gain_ = 0;
  double least_square_ = 0;
};

}  // namespace vigil
