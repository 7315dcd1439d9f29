/// The attack as whole channels, fewest first: an extension beyond the source. Specification of seed 001, section 12.
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/methods/sparse/reconstructor.hpp"

namespace vigil::sparse {
namespace {

class ChannelReconstructor final : public Reconstructor {
 public:
  ChannelReconstructor(const Params& params, const WindowShape& shape)
      : shape_(shape),
        largest_(std::min(shape.q, shape.freedom() / shape.window)),
        kappa_(params.real("kappa")),
        floor_(params.real("block_floor")),
        G_(shape.size(), shape.size()),
        b_(shape.size()),
        best_(largest_ * shape.window) {
    for (int size = 1; size <= largest_; ++size) {
      const Eigen::Index entries = size * shape.window;
      fits_.push_back({Eigen::MatrixXd(entries, entries), Eigen::VectorXd(entries), Eigen::VectorXd(entries),
                       Eigen::LDLT<Eigen::MatrixXd>(Eigen::MatrixXd::Identity(entries, entries))});
    }
  }

  std::unique_ptr<Reconstructor> clone() const override { return std::make_unique<ChannelReconstructor>(*this); }

  bool solve(const Regression& regression, Eigen::Ref<Eigen::VectorXd> E) override {
    const double eps = threshold(regression.sigma);
    E.setZero();
    if (regression.statistic <= eps || largest_ == 0) return true;
    gram(regression, G_, b_);
    double least = 0;
    for (int size = 1; size <= largest_; ++size) {
      least = best_of(size, regression.statistic * regression.statistic);
      if (least <= eps * eps) break;
    }
    if (!std::isfinite(least)) return false;
    scatter(best_set_, best_, E);
    E = (E.array().abs() < floor_).select(0, E);
    return true;
  }

  double threshold(double sigma) const override { return stop_level(kappa_, sigma, shape_.freedom()); }

 private:
  struct Fit {
    Eigen::MatrixXd gram;
    Eigen::VectorXd right, entries;
    Eigen::LDLT<Eigen::MatrixXd> factor;
  };
  using Set = std::vector<int>;

  /// Tries every set of `size` channels in order; keeps the one with the least squared residual, infinite where none
  /// could be fitted.
  double best_of(int size, double square) {
    double least = std::numeric_limits<double>::infinity();
    set_.resize(static_cast<std::size_t>(size));
    for (int c = 0; c < size; ++c) set_[static_cast<std::size_t>(c)] = c;
    for (bool more = true; more; more = advance()) {
      const double residual = fit(square);
      if (!(residual < least)) continue;
      least = residual;
      best_set_ = set_;
      best_.head(fits_[static_cast<std::size_t>(size - 1)].entries.size()) =
          fits_[static_cast<std::size_t>(size - 1)].entries;
    }
    return least;
  }

  /// The next set in lexicographic order.
  bool advance() {
    const int size = static_cast<int>(set_.size());
    int c = size - 1;
    while (c >= 0 && set_[static_cast<std::size_t>(c)] == shape_.channels - size + c) --c;
    if (c < 0) return false;
    ++set_[static_cast<std::size_t>(c)];
    for (int d = c + 1; d < size; ++d) set_[static_cast<std::size_t>(d)] = set_[static_cast<std::size_t>(d - 1)] + 1;
    return true;
  }

  Eigen::Index column(const Set& set, Eigen::Index entry) const {
    const auto size = static_cast<Eigen::Index>(set.size());
    return entry / size * shape_.channels + set[static_cast<std::size_t>(entry % size)];
  }

  /// ||M (r - E_K)||^2 of the least squares over the set's entries; NaN where they cannot be told apart.
  double fit(double square) {
    Fit& f = fits_[set_.size() - 1];
    for (Eigen::Index i = 0; i < f.right.size(); ++i) {
      f.right[i] = b_[column(set_, i)];
      for (Eigen::Index j = 0; j < f.right.size(); ++j) f.gram(i, j) = G_(column(set_, i), column(set_, j));
    }
    f.factor.compute(f.gram);
    const auto& pivots = f.factor.vectorD();
    if (f.factor.info() != Eigen::Success || !(pivots.minCoeff() > 1e-12 * pivots.maxCoeff()))
      return std::numeric_limits<double>::quiet_NaN();
    f.entries = f.right;
    f.factor.solveInPlace(f.entries);
    return std::max(square - f.right.dot(f.entries), 0.0);
  }

  void scatter(const Set& set, const Eigen::VectorXd& entries, Eigen::Ref<Eigen::VectorXd> E) const {
    for (Eigen::Index i = 0; i < static_cast<Eigen::Index>(set.size()) * shape_.window; ++i)
      E[column(set, i)] = entries[i];
  }

  WindowShape shape_;
  int largest_;  ///< set that is tried: more entries than p T - n cannot be told apart
  double kappa_, floor_;
  Eigen::MatrixXd G_;
  Eigen::VectorXd b_, best_;
  std::vector<Fit> fits_;
  Set set_, best_set_;
};

}  // namespace

std::unique_ptr<Reconstructor> make_channels(const Params& params, const WindowShape& shape) {
  return std::make_unique<ChannelReconstructor>(params, shape);
}

}  // namespace vigil::sparse
