#include "engine/methods/replay/zonotope_filter.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>

#include "engine/linalg/zonotope.hpp"
#include "engine/methods/replay/watermark.hpp"
#include "tests/engine/allocations.hpp"
#include "tests/engine/linalg/random_matrices.hpp"
#include "tests/engine/methods/replay/tank.hpp"

namespace vigil::replay::zonotope_filter_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

ZonotopeSchedule tank_schedule(int order = 20) {
  const MatrixXd M = tank::kScenarios[1].bounded();
  return *ZonotopeSchedule::make(tank::A, tank::C, M, M, order);
}

/// H with at most `order` generators, by section 8.2, item 2.
MatrixXd fewer(const MatrixXd& H, Eigen::Index order) {
  if (H.cols() <= order) return H;
  std::vector<VectorXd> columns;
  for (Eigen::Index j = 0; j < H.cols(); ++j) columns.push_back(H.col(j));
  std::stable_sort(columns.begin(), columns.end(),
                   [](const VectorXd& a, const VectorXd& b) { return a.norm() > b.norm(); });
  MatrixXd less(H.rows(), order);
  VectorXd rest = VectorXd::Zero(H.rows());
  for (std::size_t j = 0; j < columns.size(); ++j) {
    const auto place = static_cast<Eigen::Index>(j);
    if (place < order - H.rows()) less.col(place) = columns[j];
    if (place >= order - H.rows()) rest += columns[j].cwiseAbs();
  }
  less.rightCols(H.rows()) = rest.asDiagonal();
  return less;
}

TEST(ZonotopeSchedule, GivesTheTanksWatermarkSize) {
  const ZonotopeSchedule schedule = tank_schedule();
  EXPECT_NEAR(schedule.half_widths()[0], 2.860, 5e-4);
  EXPECT_NEAR(schedule.half_widths()[1], 2.659, 5e-4);
}

TEST(ZonotopeSchedule, AgreesWithTheText) {
  for (int number = 0; number < 30; ++number) {
    SCOPED_TRACE(number);
    RandomMatrices random(number);
    const int n = 1 + random.below(4), p = 1 + random.below(3), order = n + random.below(15);
    MatrixXd A = random.gaussian(n, n);
    A *= 0.9 / A.norm();
    const MatrixXd C = random.gaussian(p, n), Mw = random.definite(n), Mv = random.definite(p);
    auto schedule = ZonotopeSchedule::make(A, C, Mw, Mv, order, 40);
    ASSERT_TRUE(schedule);
    const MatrixXd Hw = Mw.diagonal().cwiseSqrt().asDiagonal(), Hv = Mv.diagonal().cwiseSqrt().asDiagonal();
    MatrixXd H = Hw, Z;
    for (int k = 0; k < 40; ++k) {
      MatrixXd Hp(n, H.cols() + n);
      Hp << A * H, Hw;
      const MatrixXd Pz = Hp * Hp.transpose();
      const MatrixXd K = Pz * C.transpose() * (C * Pz * C.transpose() + Hv * Hv.transpose()).inverse();
      MatrixXd joined(n, Hp.cols() + p);
      joined << (MatrixXd::Identity(n, n) - K * C) * Hp, K * Hv;
      H = fewer(joined, order);
      Z.resize(p, Hp.cols() + p);
      Z << C * Hp, Hv;
      ASSERT_TRUE(schedule->advance());
      EXPECT_LE((schedule->K() - K).norm(), 1e-8 * K.norm());
      ASSERT_EQ(schedule->H().cols(), H.cols());
      EXPECT_LE((schedule->H() - H).norm(), 1e-8 * H.norm());
      EXPECT_LE((schedule->Z() - Z).norm(), 1e-8 * Z.norm());
    }
    const VectorXd widths = Z.cwiseAbs().rowwise().sum();
    EXPECT_LE((schedule->half_widths() - widths).norm(), 1e-8 * widths.norm());
  }
}

// Nothing healthy is ever outside, not even where a reading was missed: the method's guarantee.
TEST(ZonotopeSchedule, AHealthyLoopStaysInside) {
  const double size = std::sqrt(0.5);
  double furthest = 0;
  for (int number = 0; number < 60; ++number) {
    SCOPED_TRACE(number);
    RandomMatrices random(100 + number);
    ZonotopeSchedule schedule = tank_schedule(number % 2 == 0 ? 20 : 4);
    const Draws secret(7, "mark");
    // Noise on the ellipsoid's surface, turning or at random: the hard cases.
    const auto noise = [&](int k) {
      const double angle = number % 3 == 0 ? 0.7 * k : 6.2831853 * random.uniform();
      return VectorXd(size * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
    };
    VectorXd truth = VectorXd::Ones(2), x = truth;
    truth += noise(0);
    for (int k = 1; k <= 300; ++k) {
      truth = tank::A * truth + noise(k);
      const VectorXd xp = tank::A * x, z = tank::C * truth + noise(k + 5) - tank::C * xp;
      if (number % 4 == 1 && k % 10 == 0) {
        ASSERT_TRUE(schedule.advance_unheard());
        x = xp;
      } else {
        ASSERT_TRUE(schedule.advance());
        const Mark mark = draw_mark(secret, k, 2 * schedule.half_widths());
        const VectorXd decoded = mark.remove(mark.apply(z));
        EXPECT_TRUE(contains(schedule.Z(), decoded));
        furthest = std::max(furthest, ratio(schedule.Z(), decoded));
        x = xp + schedule.K() * decoded;
      }
      EXPECT_TRUE(contains(schedule.H(), truth - x));
    }
  }
  EXPECT_GT(furthest, 0.5);
}

TEST(ZonotopeSchedule, KeepsAtMostItsOrder) {
  ZonotopeSchedule schedule = tank_schedule(7);
  for (int k = 0; k < 30; ++k) {
    ASSERT_TRUE(schedule.advance());
    EXPECT_LE(schedule.H().cols(), 7);
  }
}

TEST(ZonotopeSchedule, NeedsAnInvertibleInnovation) {
  const MatrixXd zero = MatrixXd::Zero(2, 2), I = MatrixXd::Identity(2, 2);
  EXPECT_FALSE(ZonotopeSchedule::make(tank::A, tank::C, zero, zero, 20));
  EXPECT_TRUE(ZonotopeSchedule::make(tank::A, tank::C, I, zero, 20));
  EXPECT_FALSE(ZonotopeSchedule::make(tank::A, MatrixXd({{1, 2}, {2, 4}}), I, zero, 20));
}

#ifdef VIGIL_COUNTS_MALLOC
TEST(ZonotopeSchedule, AStepAllocatesNothing) {
  RandomMatrices random(9);
  for (const int n : {2, 6}) {
    const MatrixXd A = 0.9 * random.orthogonal(n), M = random.definite(n);
    auto schedule = *ZonotopeSchedule::make(A, random.gaussian(3, n), M, random.definite(3), 30);
    bool done = true;
    EXPECT_EQ(allocations_in([&] {
                for (int k = 0; k < 40; ++k)
                  done = done && (k % 5 == 3 ? schedule.advance_unheard() : schedule.advance());
              }),
              0);
    EXPECT_TRUE(done);
    EXPECT_EQ(schedule.H().cols(), 30);
  }
}
#endif

}  // namespace
}  // namespace vigil::replay::zonotope_filter_test
