/// Solvers for the attack E of a window: one file each.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <memory>

#include "engine/core/params.hpp"
#include "engine/methods/sparse/window.hpp"

namespace vigil::sparse {

/// What the windows of a lane look like.
struct WindowShape {
  int channels = 0;  ///< p
  int window = 0;    ///< T
  int states = 0;    ///< n
  int q = 0;         ///< attacked channels of a node at most
  int size() const { return channels * window; }
  int freedom() const { return std::max(size() - states, 0); }  ///< m = p T - n
};

/// Works in buffers made once; shared by the nodes of a lane.
class Reconstructor {
 public:
  virtual ~Reconstructor() = default;
  virtual std::unique_ptr<Reconstructor> clone() const = 0;
  /// Writes the attack (size p T), exactly zero where none is found. False where the solver failed: E is zero then.
  virtual bool solve(const Regression& regression, Eigen::Ref<Eigen::VectorXd> E) = 0;
  /// What the statistic ||M r|| is compared with, for a channel of standard deviation sigma; NaN: nothing.
  virtual double threshold(double /*sigma*/) const { return std::numeric_limits<double>::quiet_NaN(); }
  /// True where an entry that is not zero means an attack that was found, rather than a small number.
  virtual bool selects() const { return true; }
};

/// eps = kappa sigma sqrt(m + 2 sqrt(m ln m)), the Gaussian stopping rule inflated: specification, section 8.
double stop_level(double kappa, double sigma, int freedom);
/// M W for the Gram matrix: G = W' M W (p T x p T) and b = W' M W r, blockwise.
void gram(const Regression& regression, Eigen::MatrixXd& G, Eigen::VectorXd& b);

/// A1: orthogonal matching pursuit. params: kappa, stop.
std::unique_ptr<Reconstructor> make_omp(const Params& params, const WindowShape& shape);
/// A2: the smallest l1 norm that explains the window exactly.
std::unique_ptr<Reconstructor> make_l1(const Params& params, const WindowShape& shape);
/// A4: event-triggered projected gradient. params: shrink, max_steps, projection.
std::unique_ptr<Reconstructor> make_gradient(const Params& params, const WindowShape& shape);
/// The extension: whole channels, fewest first. params: kappa, block_floor.
std::unique_ptr<Reconstructor> make_channels(const Params& params, const WindowShape& shape);

}  // namespace vigil::sparse
