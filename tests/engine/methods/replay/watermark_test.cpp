#include "engine/methods/replay/watermark.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "tests/engine/allocations.hpp"

namespace vigil::replay::watermark_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

TEST(Watermark, WhatIsMarkedComesBack) {
  const Draws draws(3, "secret");
  for (int p = 1; p <= 6; ++p) {
    const VectorXd size = VectorXd::LinSpaced(p, 1, 2), z = VectorXd::LinSpaced(p, -1, 5);
    for (std::int64_t k = 1; k <= 200; ++k) {
      const Mark mark = draw_mark(draws, k, size);
      EXPECT_LE((mark.E * mark.E.transpose() - MatrixXd::Identity(p, p)).norm(), 1e-13);
      if (p > 1) {
        EXPECT_NEAR(mark.E.determinant(), 1, 1e-13);
      }
      EXPECT_TRUE((mark.m.cwiseAbs().array() <= size.array()).all());
      EXPECT_LE((mark.remove(mark.apply(z)) - z).norm(), 1e-13 * (z.norm() + size.norm()));
      EXPECT_GT((mark.remove(draw_mark(draws, k + 1, size).apply(z)) - z).norm(), 1e-6);
    }
  }
}

TEST(Watermark, TheSameAddressGivesTheSameMark) {
  const VectorXd size = VectorXd::Ones(3);
  const Mark one = draw_mark(Draws(3, "secret"), 7, size), same = draw_mark(Draws(3, "secret"), 7, size),
             other = draw_mark(Draws(4, "secret"), 7, size);
  EXPECT_EQ(one.E, same.E);
  EXPECT_EQ(one.m, same.m);
  EXPECT_NE(one.E, other.E);
  EXPECT_NE(one.m, other.m);
}

// Uniform: no direction is preferred, and the offsets have the box's mean and variance. Five standard errors of 4000.
TEST(Watermark, NoDirectionIsPreferred) {
  const Draws draws(5, "secret");
  const int count = 4000;
  for (int p = 1; p <= 4; ++p) {
    MatrixXd mean = MatrixXd::Zero(p, p), square = mean;
    VectorXd offset = VectorXd::Zero(p), spread = offset;
    for (std::int64_t k = 0; k < count; ++k) {
      const Mark mark = draw_mark(draws, k, VectorXd::Constant(p, 2));
      mean += MatrixXd(mark.E) / count;
      square += MatrixXd(mark.E.cwiseAbs2()) / count;
      offset += VectorXd(mark.m) / count;
      spread += VectorXd(mark.m.cwiseAbs2()) / count;
    }
    EXPECT_LE(mean.cwiseAbs().maxCoeff(), 5 / std::sqrt(count * p));
    EXPECT_LE((square.array() - 1.0 / p).abs().maxCoeff(), 5 * 0.36 / std::sqrt(count));
    EXPECT_LE(offset.cwiseAbs().maxCoeff(), 5 * 2 / std::sqrt(3.0 * count));
    EXPECT_LE((spread.array() - 4.0 / 3).abs().maxCoeff(), 5 * 1.2 / std::sqrt(count));
  }
}

#ifdef VIGIL_COUNTS_MALLOC
TEST(Watermark, DrawingAllocatesNothing) {
  const Draws draws(5, "secret");
  for (const int p : {1, 2, 5}) {
    const VectorXd size = VectorXd::Ones(p);
    double sum = 0;
    EXPECT_EQ(allocations_in([&] { sum = draw_mark(draws, 3, size).m.sum(); }), 0);
    EXPECT_NE(sum, 0);
  }
}
#endif

}  // namespace
}  // namespace vigil::replay::watermark_test
