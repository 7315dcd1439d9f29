/// The attack by event-triggered projected gradient descent (Shoukry and Tabuada, 2016, restated). Specification of
/// seed 001, section 11, A4.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <numeric>

#include "engine/methods/sparse/reconstructor.hpp"

namespace vigil::sparse {
namespace {

constexpr int kLongestWait = 30;  ///< steps after which an event comes by itself
constexpr double kEnough = 1e-6;  ///< V at which the descent ends

class GradientReconstructor final : public Reconstructor {
 public:
  GradientReconstructor(const Params& params, const WindowShape& shape)
      : shape_(shape),
        shrink_(params.real("shrink")),
        max_steps_(params.integer("max_steps")),
        by_block_(params.text("projection") == "block"),
        E_(shape.size()),
        projected_(shape.size()),
        unexplained_(shape.size()),
        gradient_(shape.size()),
        keys_(static_cast<std::size_t>(by_block_ ? shape.channels : shape.size())),
        order_(keys_.size()) {}

  std::unique_ptr<Reconstructor> clone() const override { return std::make_unique<GradientReconstructor>(*this); }

  bool solve(const Regression& regression, Eigen::Ref<Eigen::VectorXd> out) override {
    const Eigen::MatrixXd& Phi = regression.Phi;
    BoundedMatrix square(shape_.states, shape_.states);
    square.noalias() = Phi.transpose() * Phi;
    const Eigen::SelfAdjointEigenSolver<BoundedMatrix> spectrum(square, Eigen::EigenvaluesOnly);
    const double eta = 1 / (spectrum.eigenvalues().maxCoeff() + 1);
    BoundedVector x = BoundedVector::Zero(shape_.states);
    E_.setZero();
    unexplained_ = regression.r;  // r - Phi x
    double last = 0.5 * regression.r.squaredNorm();
    int since = 0;
    for (int step = 0; step < max_steps_ && last > kEnough; ++step) {
      gradient_ = unexplained_ - E_;
      x.noalias() += eta * (Phi.transpose() * gradient_);
      E_ += eta * gradient_;
      unexplained_ = regression.r;
      unexplained_.noalias() -= Phi * x;
      project(E_, projected_);
      const double energy = 0.5 * (unexplained_ - projected_).squaredNorm();
      if (energy <= (1 - shrink_) * last || ++since >= kLongestWait) {
        E_ = projected_;
        last = energy;
        since = 0;
      }
    }
    project(E_, projected_);
    out = projected_;
    if (out.allFinite()) return true;
    out.setZero();
    return false;
  }

  bool selects() const override { return false; }

 private:
  /// Pi: keeps the q channels with the most energy over the window, or the q T largest entries; the lowest on ties.
  void project(const Eigen::VectorXd& E, Eigen::VectorXd& kept) {
    const auto p = static_cast<std::size_t>(shape_.channels);
    std::fill(keys_.begin(), keys_.end(), 0.0);
    for (Eigen::Index i = 0; i < E.size(); ++i)
      keys_[by_block_ ? static_cast<std::size_t>(i) % p : static_cast<std::size_t>(i)] += E[i] * E[i];
    const auto wanted =
        std::min(static_cast<std::size_t>(by_block_ ? shape_.q : shape_.q * shape_.window), keys_.size());
    std::iota(order_.begin(), order_.end(), 0);
    std::partial_sort(
        order_.begin(), order_.begin() + static_cast<std::ptrdiff_t>(wanted), order_.end(), [&](int one, int other) {
          const double a = keys_[static_cast<std::size_t>(one)], b = keys_[static_cast<std::size_t>(other)];
          return a != b ? a > b : one < other;
        });
    kept.setZero();
    for (std::size_t k = 0; k < wanted; ++k) {
      if (!by_block_) {
        kept[order_[k]] = E[order_[k]];
        continue;
      }
      for (Eigen::Index i = order_[k]; i < E.size(); i += shape_.channels) kept[i] = E[i];
    }
  }

  WindowShape shape_;
  double shrink_;  ///< nu
  int max_steps_;
  bool by_block_;
  Eigen::VectorXd E_, projected_, unexplained_, gradient_;
  std::vector<double> keys_;
  std::vector<int> order_;
};

}  // namespace

std::unique_ptr<Reconstructor> make_gradient(const Params& params, const WindowShape& shape) {
  return std::make_unique<GradientReconstructor>(params, shape);
}

}  // namespace vigil::sparse
