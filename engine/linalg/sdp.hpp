/// Semidefinite programs in the inequality form: minimise c'y subject to y_1 F_1 + … + y_m F_m - F_0 >= 0, block by
/// block. Problem in, y and a verdict out; whoever solves is behind an interface. Specification (observer), section 6.
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/json.hpp"

namespace vigil {

/// One entry of a symmetric block of one F, with its mirror image.
struct SdpEntry {
  int matrix = 0;  ///< 0 is F_0, k is the matrix of y_k, from 1
  int block = 0;   ///< from 0
  int row = 0;     ///< from 0, row <= column
  int column = 0;
  double value = 0;
  bool operator==(const SdpEntry&) const = default;
};

struct SdpProblem {
  std::vector<double> cost;       ///< c, as long as y
  std::vector<int> blocks;        ///< the order of every block
  std::vector<SdpEntry> entries;  ///< by matrix, block, row, column; none twice, none zero

  int variables() const { return static_cast<int>(cost.size()); }
  bool operator==(const SdpProblem&) const = default;
};

/// Sorts the entries, turns those below the diagonal, adds up those given twice and drops zeros. Throws
/// std::invalid_argument where an entry lies outside its block or a number is not finite.
void canonicalise(SdpProblem& problem);

/// 16 hexadecimal digits of everything in a canonical problem (FNV-1a).
std::string content_hash(const SdpProblem& problem);

/// c'y.
double objective(const SdpProblem& problem, const Eigen::VectorXd& y);
/// The blocks of y_1 F_1 + … - F_0.
std::vector<Eigen::MatrixXd> blocks_at(const SdpProblem& problem, const Eigen::VectorXd& y);
/// The smallest eigenvalue of each of them: the margins; all are >= 0 where y is feasible.
std::vector<double> smallest_eigenvalues(const SdpProblem& problem, const Eigen::VectorXd& y);

/// {"cost":[…],"blocks":[…],"entries":[[matrix,block,row,column,value],…]}, every double exactly.
Json to_json(const SdpProblem& problem);
/// Throws InputError below `pointer` where the document is not such a problem.
SdpProblem read_sdp(const Json& document, const std::string& pointer = "");

/// SDPA's sparse text format (upper triangles, indices from 1), every double exactly: what csdp, sdpa and dsdp5 read.
std::string to_sdpa(const SdpProblem& problem, const std::string& title = "");
/// The same text read back. Throws InputError with the line's number.
SdpProblem read_sdpa(std::string_view text);

enum class SdpVerdict {
  solved,      ///< the solver reached its own tolerance
  stopped,     ///< it stopped short with a y worth looking at: only a certificate tells
  infeasible,  ///< it says that no y fits
  timed_out,   ///< its limit passed; y may still be worth looking at
  failed       ///< no y
};
std::string_view to_string(SdpVerdict verdict);

struct SdpSolution {
  Eigen::VectorXd y;  ///< empty where there is none
  SdpVerdict verdict = SdpVerdict::failed;
  int iterations = 0;
  double seconds = 0;
  std::string detail;  ///< the solver's own last word, for people
};
Json to_json(const SdpSolution& solution);
/// Throws InputError below `pointer`.
SdpSolution read_sdp_solution(const Json& document, const std::string& pointer = "");

class SdpSolver {
 public:
  virtual ~SdpSolver() = default;
  virtual std::string_view name() const = 0;
  /// limit: seconds. Never throws for what a problem holds; the verdict says what happened.
  virtual SdpSolution solve(const SdpProblem& problem, double limit) = 0;
};

}  // namespace vigil
