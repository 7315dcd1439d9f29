#include "engine/methods/replay/batch.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "engine/linalg/covariance.hpp"
#include "engine/linalg/ellipsoid.hpp"
#include "tests/engine/linalg/random_matrices.hpp"
#include "tests/engine/methods/replay/tank.hpp"

namespace vigil::replay::batch_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Plant {
  MatrixXd A, B, C;
};

Plant random_plant(RandomMatrices& random) {
  const int n = 1 + random.below(4), m = 1 + random.below(2), p = 1 + random.below(3);
  return {random.gaussian(n, n) + 0.5 * MatrixXd::Identity(n, n), random.gaussian(n, m), random.gaussian(p, n)};
}

/// States and readings of samples m..e = m + n - 1 from x_{m-1}. Columns: u_{m-1}..u_{e-1}, process noise of the same
/// samples, sensor noise of m..e.
struct Window {
  MatrixXd Y;
  VectorXd last;
  Window(const Plant& plant, VectorXd x, const MatrixXd& U, const MatrixXd& of_process, const MatrixXd& of_sensor)
      : Y(plant.C.rows(), U.cols()) {
    for (Eigen::Index i = 0; i < U.cols(); ++i) {
      x = plant.A * x + plant.B * U.col(i) + of_process.col(i);
      Y.col(i) = plant.C * x + of_sensor.col(i);
    }
    last = x;
  }
};

TEST(Batch, WithoutNoiseItIsTheState) {
  for (int number = 0; number < 200; ++number) {
    SCOPED_TRACE(number);
    RandomMatrices random(number);
    const Plant plant = random_plant(random);
    const auto n = plant.A.rows(), m = plant.B.cols(), p = plant.C.rows();
    const auto batch = Batch::make(plant.A, plant.B, plant.C);
    ASSERT_TRUE(batch);
    EXPECT_EQ(batch->length(), n);
    const MatrixXd U = random.gaussian(m, n);
    const Window window(plant, random.vector(n), U, MatrixXd::Zero(n, n), MatrixXd::Zero(p, n));
    EXPECT_LE((batch->estimate(window.Y, U) - window.last).norm(), 1e-7 * (1 + batch->GH().norm()));
  }
}

// G = (H'H)^-1 with H = [C A^-(n-1); ..; C].
TEST(Batch, ItsMatricesAreThePrintedOnes) {
  for (int number = 0; number < 100; ++number) {
    SCOPED_TRACE(number);
    RandomMatrices random(1000 + number);
    const Plant plant = random_plant(random);
    const auto n = plant.A.rows(), p = plant.C.rows();
    const auto batch = Batch::make(plant.A, plant.B, plant.C);
    ASSERT_TRUE(batch);
    MatrixXd H(n * p, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      MatrixXd power = MatrixXd::Identity(n, n);
      for (auto times = i + 1; times < n; ++times) power = power * plant.A.inverse();
      H.middleRows(i * p, p) = plant.C * power;
    }
    const MatrixXd G = (H.transpose() * H).inverse();
    const double lost = 1e-13 * std::pow(H.norm(), 2) * G.norm();
    EXPECT_LE((batch->G() - G).norm(), lost * G.norm());
    EXPECT_LE((batch->GH() - G * H.transpose()).norm(), lost * batch->GH().norm());
  }
}

// The error is linear in the noise: what a unit of each does, added up.
TEST(Batch, ItsErrorSetsAreThoseOfUnitNoises) {
  for (int number = 0; number < 100; ++number) {
    SCOPED_TRACE(number);
    RandomMatrices random(2000 + number);
    const Plant plant = random_plant(random);
    const int n = static_cast<int>(plant.A.rows()), m = static_cast<int>(plant.B.cols()),
              p = static_cast<int>(plant.C.rows());
    const auto batch = Batch::make(plant.A, plant.B, plant.C);
    ASSERT_TRUE(batch);
    const MatrixXd P = random.definite(n), R = random.definite(p), Mw = random.semidefinite(n, random.below(n + 1)),
                   Mv = random.semidefinite(p, random.below(p + 1));
    const MatrixXd U = MatrixXd::Zero(m, n);
    const auto response = [&](bool of_process, Eigen::Index sample) {
      const auto size = of_process ? n : p;
      MatrixXd errors(n, size);
      for (Eigen::Index i = 0; i < size; ++i) {
        MatrixXd process = MatrixXd::Zero(n, n), sensor = MatrixXd::Zero(p, n);
        (of_process ? process : sensor)(i, sample) = 1;
        const Window window(plant, VectorXd::Zero(n), U, process, sensor);
        errors.col(i) = window.last - batch->estimate(window.Y, U);
      }
      return errors;
    };
    MatrixXd Q = MatrixXd::Zero(n, n), sum = Q;
    double roots = 0;
    for (Eigen::Index sample = 0; sample < n; ++sample) {
      const MatrixXd T = response(true, sample), V = response(false, sample);
      Q += T * P * T.transpose() + V * R * V.transpose();
      for (const MatrixXd& E : {MatrixXd(T * Mw * T.transpose()), MatrixXd(V * Mv * V.transpose())}) {
        const double root = std::sqrt(E.trace());
        roots += root;
        if (root > 0) sum += E / root;
      }
    }
    const Bounds bounds = batch->error(P, R, Mw, Mv);
    EXPECT_LE((bounds.Q - Q).norm(), 1e-9 * Q.norm());
    EXPECT_LE((bounds.M - roots * sum).norm(), 1e-7 * (roots * sum).norm());
    EXPECT_GE(least_eigenvalue(bounds.Q), -1e-12 * Q.norm());
    EXPECT_GE(least_eigenvalue(bounds.M), -1e-12 * (1 + bounds.M.norm()));
  }
}

// The iterated filter of 4.2 from this batch is the least-squares fit over the whole horizon.
TEST(Batch, TheUnbiasedFilterFromItIsTheFitOverItsHorizon) {
  for (int number = 0; number < 50; ++number) {
    SCOPED_TRACE(number);
    RandomMatrices random(3000 + number);
    Plant plant = random_plant(random);
    const auto n = plant.A.rows(), m = plant.B.cols(), p = plant.C.rows();
    plant.A = random.log_uniform(0.7, 1.3) * random.orthogonal(n);  // or the filter's own inverses lose the digits
    const Eigen::Index horizon = n + 5;
    const auto batch = Batch::make(plant.A, plant.B, plant.C);
    ASSERT_TRUE(batch);
    const MatrixXd U = random.gaussian(m, horizon), Y = random.gaussian(p, horizon);
    VectorXd x = batch->estimate(Y.leftCols(n), U.leftCols(n));
    MatrixXd G = batch->G();
    for (auto l = n; l < horizon; ++l) {
      const VectorXd xp = plant.A * x + plant.B * U.col(l);
      G = (plant.C.transpose() * plant.C + (plant.A * G * plant.A.transpose()).inverse()).inverse();
      x = xp + G * plant.C.transpose() * (Y.col(l) - plant.C * xp);
    }
    // y_i = C A^i x_before + C sum_j A^(i-j) B u_j, in the unknown x_before.
    MatrixXd H(horizon * p, n);
    VectorXd rest(horizon * p), driven = VectorXd::Zero(n);
    MatrixXd power = MatrixXd::Identity(n, n);
    for (Eigen::Index i = 0; i < horizon; ++i) {
      power = plant.A * power;
      driven = plant.A * driven + plant.B * U.col(i);
      H.middleRows(i * p, p) = plant.C * power;
      rest.segment(i * p, p) = Y.col(i) - plant.C * driven;
    }
    const VectorXd fitted = power * H.colPivHouseholderQr().solve(rest) + driven;
    EXPECT_LE((x - fitted).norm(), 1e-8 * (1 + fitted.norm() + batch->GH().norm()));
  }
}

TEST(Batch, RefusesWhatItCannotSee) {
  const MatrixXd I = MatrixXd::Identity(2, 2), B = MatrixXd::Ones(2, 1);
  EXPECT_FALSE(Batch::make(MatrixXd({{1, 1}, {1, 1}}), B, I));
  EXPECT_FALSE(Batch::make(MatrixXd({{1, 0}, {0, 1}}), B, MatrixXd({{1, 1}})));
  EXPECT_FALSE(Batch::make(I, B, MatrixXd::Zero(1, 2)));
  EXPECT_FALSE(Batch::make(MatrixXd({{1, std::nan("")}, {0, 1}}), B, I));
  EXPECT_TRUE(Batch::make(MatrixXd({{1, 1}, {0, 1}}), B, MatrixXd({{1, 0}})));
  EXPECT_FALSE(Batch::make(MatrixXd({{1, 1}, {0, 1}}), B, MatrixXd({{0, 1}})));
}

}  // namespace
}  // namespace vigil::replay::batch_test
