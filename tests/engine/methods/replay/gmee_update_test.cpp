#include "engine/methods/replay/gmee_update.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "engine/linalg/covariance.hpp"
#include "tests/engine/allocations.hpp"
#include "tests/engine/linalg/random_matrices.hpp"
#include "tests/engine/methods/replay/tank.hpp"

namespace vigil::replay::gmee_update_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Step {
  VectorXd x;
  MatrixXd P;
  int iterations = 0;
  bool converged = false;
};

/// Section 8.1 line by line, every matrix written out.
Step by_the_text(const MatrixXd& C, const MatrixXd& R, const GmeeSettings& set, const VectorXd& xp, const MatrixXd& Pp,
                 const VectorXd& y) {
  const auto n = xp.size(), p = y.size(), l = n + p;
  MatrixXd Theta = MatrixXd::Zero(l, l), stacked(l, n);
  Theta.topLeftCorner(n, n) = MatrixXd(Pp.llt().matrixL());
  const MatrixXd root = R.llt().matrixL();
  Theta.bottomRightCorner(p, p) = root;
  stacked << MatrixXd::Identity(n, n), C;
  VectorXd read(l);
  read << xp, y;
  const MatrixXd Wt = Theta.inverse() * stacked;
  const VectorXd d = Theta.inverse() * read;
  Step step{xp, Pp};
  MatrixXd K;
  while (step.iterations < 50 && !step.converged) {
    ++step.iterations;
    const VectorXd e = d - Wt * step.x;
    MatrixXd Phi(l, l);
    for (Eigen::Index i = 0; i < l; ++i) {
      for (Eigen::Index j = 0; j < l; ++j) {
        double gap = std::abs(e[i] - e[j]);
        if (set.alpha != 2) gap = std::max(gap, 1e-6);
        Phi(i, j) = std::pow(gap, set.alpha - 2) * std::exp(-std::pow(gap / set.beta, set.alpha));
      }
      if (set.alpha != 2 || set.form == GmeeForm::diff) Phi(i, i) = 0;
    }
    const MatrixXd Psi = Phi.rowwise().sum().asDiagonal();
    const MatrixXd Lam =
        set.form == GmeeForm::square ? MatrixXd(Psi.transpose() * Psi + Phi.transpose() * Phi) : MatrixXd(Psi - Phi);
    const MatrixXd bare = Wt.transpose() * Lam * Wt;
    const MatrixXd Om = bare + 1e-12 * bare.trace() * MatrixXd::Identity(n, n);
    K = Om.inverse() * (Wt.transpose() * Lam).rightCols(p) * root.inverse();
    const VectorXd next = xp + K * (y - C * xp);
    step.converged = (next - step.x).norm() <= 1e-6 * std::max(step.x.norm(), 1e-12);
    step.x = next;
  }
  const MatrixXd X = MatrixXd::Identity(n, n) - K * C;
  step.P = X * Pp * X.transpose() + K * R * K.transpose();
  return step;
}

TEST(GmeeUpdate, AgreesWithTheText) {
  for (int number = 0; number < 300; ++number) {
    SCOPED_TRACE(number);
    RandomMatrices random(number);
    const int n = 1 + random.below(4), p = 1 + random.below(3);
    const MatrixXd C = random.gaussian(p, n), R = random.definite(p), Pp = random.definite(n);
    const double alphas[] = {2, 3, 1.5, 2};
    const GmeeSettings settings{alphas[number % 4], random.log_uniform(1, 8),
                                (number / 4) % 2 == 0 ? GmeeForm::square : GmeeForm::diff};
    const VectorXd xp = random.vector(n), y = C * xp + 3 * random.vector(p);
    const Step expected = by_the_text(C, R, settings, xp, Pp, y);
    const auto got = GmeeUpdate(C, R, settings).update(xp, Pp, y);
    ASSERT_TRUE(got);
    EXPECT_EQ(got->converged, expected.converged);
    EXPECT_EQ(got->iterations, expected.iterations);
    // What runs into the cap wanders, and rounding with it.
    const double tolerance = expected.converged ? 1e-6 : 1e-4;
    EXPECT_LE((got->x - expected.x).norm(), tolerance * expected.x.norm());
    EXPECT_LE((got->P - expected.P).norm(), tolerance * expected.P.norm());
    EXPECT_GE(least_eigenvalue(got->P), -1e-12 * got->P.norm());
  }
}

/// A pass over the tank with its own noise: how many of its steps did not converge.
int capped(const GmeeSettings& settings, double& furthest) {
  const MatrixXd R = tank::kScenarios[0].noise();
  const GmeeUpdate update(tank::C, R, settings);
  RandomMatrices random(1);
  VectorXd x = VectorXd::Ones(2), truth = x, expected = x;
  MatrixXd P = R, expected_P = R;
  int count = 0;
  furthest = 0;
  for (int k = 0; k < 300; ++k) {
    const auto noise = [&] { return std::sqrt(0.2 / 3.4) * (random.uniform() < 0.9 ? 1 : 5) * random.normal(); };
    truth = tank::A * truth + VectorXd::NullaryExpr(2, [&] { return noise(); });
    const VectorXd y = tank::C * truth + VectorXd::NullaryExpr(2, [&] { return noise(); });
    const auto step = update.update(tank::A * x, tank::A * P * tank::A.transpose() + R, y);
    const Step other =
        by_the_text(tank::C, R, settings, tank::A * expected, tank::A * expected_P * tank::A.transpose() + R, y);
    x = step->x;
    P = step->P;
    expected = other.x;
    expected_P = other.P;
    furthest = std::max(furthest, (x - expected).norm() / (1 + expected.norm()));
    count += step->converged ? 0 : 1;
  }
  return count;
}

// What the specification reports of alpha = 3: the iteration runs into its cap.
TEST(GmeeUpdate, APassOverTheTankFollowsTheText) {
  double furthest = 0;
  const int usual = capped({2, 2, GmeeForm::square}, furthest);
  EXPECT_LE(furthest, 1e-8);
  const int cubic = capped({3, 2, GmeeForm::square}, furthest);
  EXPECT_LE(furthest, 1e-8);
  EXPECT_LT(usual, 15);
  EXPECT_GT(cubic, 150);
  EXPECT_EQ(capped({2, 5, GmeeForm::square}, furthest), 0);
  EXPECT_LE(furthest, 1e-8);
  EXPECT_EQ(capped({2, 5, GmeeForm::diff}, furthest), 0);
  EXPECT_LE(furthest, 1e-8);
}

TEST(GmeeUpdate, AnOutlyingReadingIsDiscounted) {
  const MatrixXd C = MatrixXd::Ones(3, 1), I = MatrixXd::Identity(3, 3);
  const BoundedVector y = Eigen::Vector3d(0.1, -0.1, 50);
  const auto step = GmeeUpdate(C, I, {}).update(BoundedVector::Zero(1), BoundedMatrix::Identity(1, 1), y);
  ASSERT_TRUE(step);
  EXPECT_LT(std::abs(step->x[0]), 5);  // Kalman's is 12.5
}

TEST(GmeeUpdate, RefusesSingularCovariances) {
  const MatrixXd I = MatrixXd::Identity(2, 2), zero = MatrixXd::Zero(2, 2);
  const BoundedVector x = BoundedVector::Ones(2);
  EXPECT_FALSE(GmeeUpdate(tank::C, zero, {}).update(x, I, x));
  EXPECT_FALSE(GmeeUpdate(tank::C, I, {}).update(x, zero, x));
  EXPECT_TRUE(GmeeUpdate(tank::C, I, {}).update(x, I, x));
  EXPECT_FALSE(GmeeUpdate(tank::C, I, {}).update(x, I, BoundedVector::Constant(2, std::nan(""))));
}

#ifdef VIGIL_COUNTS_MALLOC
TEST(GmeeUpdate, AStepAllocatesNothing) {
  RandomMatrices random(2);
  for (const int p : {2, 6}) {
    const MatrixXd C = random.gaussian(p, 6);
    const GmeeUpdate update(C, random.definite(p), {});
    const BoundedVector x = random.vector(6), y = random.vector(p);
    const BoundedMatrix P = random.definite(6);
    bool done = false;
    EXPECT_EQ(allocations_in([&] { done = update.update(x, P, y).has_value(); }), 0);
    EXPECT_TRUE(done);
  }
}
#endif

}  // namespace
}  // namespace vigil::replay::gmee_update_test
