/// What matching pursuit finds of an attack on both channels of a station throughout a window that is linearised at the
/// truth itself: never the support. Specification of seed 001, section 12.
#include <gtest/gtest.h>

#include "tests/engine/methods/sparse/windows.hpp"

namespace vigil::support_test {
namespace {

using windows::Tampering;

struct Found {
  int exact = 0, range = 0, azimuth = 0;  ///< windows; entries of 6 a window each
};

/// Sixty windows along the noise-free track, stations in turn.
Found found(Tampering tampering, double noise) {
  const Json places[] = {{-6, 8, 0}, {-10, 0, 0}, {-6, -8, 0}, {6, -8, 0}, {0, -10, 0}};
  const auto omp = sparse::make_omp(rig::completed("omp_ekf"), {6, 6, 6, 2});
  const Eigen::MatrixXd F = windows::loop();
  Found result;
  Eigen::VectorXd x(6), E(36);
  x << 10, 0, 10, 0, 8, 0;
  for (std::uint64_t trial = 0; trial < 60; ++trial) {
    windows::Scene scene{windows::station(places[trial % 5]), 6, Eigen::MatrixXd(6, 6), Eigen::MatrixXd(6, 6), {}};
    const Draws lie(trial, "lie");
    Eigen::VectorXd z = x, y(6);
    for (int j = 0; j < 6; ++j) {
      z = F * z;
      scene.sensor->measure(z, y);
      y += noise * windows::normals(trial, "noise", j, 6);
      const bool constant = tampering == Tampering::constant;
      y[0] += 10 * lie.uniform(j, 0) - 5 + (constant ? 10 : 0);
      y[1] += 2 * std::numbers::pi * lie.uniform(constant ? 0 : j, 1);
      scene.readings.col(j) = y;
      scene.met.col(j) = z;
    }
    scene.prior = z;
    EXPECT_TRUE(omp->solve(windows::regress(scene), E));
    int range = 0, azimuth = 0;
    for (int j = 0; j < 6; ++j) {
      range += E[6 * j] != 0 ? 1 : 0;
      azimuth += E[6 * j + 1] != 0 ? 1 : 0;
    }
    result.exact += range + azimuth == 12 && (E.array() != 0).count() == 12 ? 1 : 0;
    result.range += range;
    result.azimuth += azimuth;
    for (int k = 0; k < 3; ++k) x = F * x;
  }
  return result;
}

// 60 windows of 12 entries; the specification's own sixty gave 80 % and 38 %.
TEST(SupportAtTheTruth, IsNeverFound) {
  for (const double noise : {0.0, 0.01}) {
    const Found one = found(Tampering::random, noise), two = found(Tampering::constant, noise);
    EXPECT_EQ(one.exact, 0) << noise;
    EXPECT_EQ(two.exact, 0) << noise;
    EXPECT_NEAR((one.range + one.azimuth) / 720.0, 0.80, 0.05) << noise;
    EXPECT_NEAR((two.range + two.azimuth) / 720.0, 0.38, 0.05) << noise;
    EXPECT_TRUE(noise > 0 || two.azimuth == 0) << "range deviations alone, nothing of the constant azimuth";
  }
}

}  // namespace
}  // namespace vigil::support_test
