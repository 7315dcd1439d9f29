/// The attack by orthogonal matching pursuit. Seed 001, eq. (6); specification, section 8.
#include <cmath>

#include "engine/linalg/omp.hpp"
#include "engine/methods/sparse/reconstructor.hpp"

namespace vigil::sparse {

double stop_level(double kappa, double sigma, int freedom) {
  if (freedom < 1) return 0;
  const double m = freedom;
  return kappa * sigma * std::sqrt(m + 2 * std::sqrt(m * std::log(m)));
}

void gram(const Regression& regression, Eigen::MatrixXd& G, Eigen::VectorXd& b) {
  b = regression.left;
  G.setIdentity();
  G.noalias() -= regression.Q1 * regression.Q1.transpose();
  if (regression.sigma != 1) return;
  const Eigen::Index p = regression.whiten.rows(), blocks = regression.r.size() / p;
  BoundedVector part(p);
  BoundedMatrix half(p, p), block(p, p);
  for (Eigen::Index i = 0; i < blocks; ++i) {
    part.noalias() = regression.whiten.transpose() * regression.left.segment(i * p, p);
    b.segment(i * p, p) = part;
    for (Eigen::Index j = 0; j < blocks; ++j) {
      half.noalias() = G.block(i * p, j * p, p, p) * regression.whiten;
      block.noalias() = regression.whiten.transpose() * half;
      G.block(i * p, j * p, p, p) = block;
    }
  }
}

namespace {

class OmpReconstructor final : public Reconstructor {
 public:
  OmpReconstructor(const Params& params, const WindowShape& shape)
      : kappa_(params.real("kappa")),
        by_noise_(params.text("stop") == "noise"),
        freedom_(shape.freedom()),
        picks_(std::min(shape.q * shape.window, freedom_)),
        omp_(shape.size(), picks_),
        G_(shape.size(), shape.size()),
        b_(shape.size()) {}

  std::unique_ptr<Reconstructor> clone() const override { return std::make_unique<OmpReconstructor>(*this); }

  bool solve(const Regression& regression, Eigen::Ref<Eigen::VectorXd> E) override {
    const double eps = by_noise_ ? stop_level(kappa_, regression.sigma, freedom_) : 0;
    E.setZero();
    if (regression.statistic <= eps || picks_ == 0) return true;
    gram(regression, G_, b_);
    if (!omp_.solve_gram(G_, b_, regression.statistic, picks_, eps)) return false;
    E = omp_.entries();
    return true;
  }

  double threshold(double sigma) const override {
    return by_noise_ ? stop_level(kappa_, sigma, freedom_) : Reconstructor::threshold(sigma);
  }

 private:
  double kappa_;
  bool by_noise_;
  int freedom_, picks_;
  Omp omp_;
  Eigen::MatrixXd G_;
  Eigen::VectorXd b_;
};

}  // namespace

std::unique_ptr<Reconstructor> make_omp(const Params& params, const WindowShape& shape) {
  return std::make_unique<OmpReconstructor>(params, shape);
}

}  // namespace vigil::sparse
