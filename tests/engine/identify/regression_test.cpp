#include "engine/identify/regression.hpp"

#include <cmath>

#include "engine/identify/whiteness.hpp"
#include "engine/random/draws.hpp"

namespace vigil::identify::regression_test {
namespace {

TEST(Regression, IsExactWhereTheDataAre) {
  Eigen::MatrixXd Z(6, 2), W(2, 2);
  Z << 1, 2, 3, 5, -1, 0, 4, 4, 2, -3, 0, 1;
  W << 0.5, -2, 3, 0.25;
  const Eigen::MatrixXd Y = (Z * W.transpose()).rowwise() + Eigen::RowVector2d(1000, -7);
  const Regression found = regress(Z, Y);
  EXPECT_LT((found.weights - W).norm(), 1e-10);
  EXPECT_LT((found.constant - Eigen::Vector2d(1000, -7)).norm(), 1e-9);
  EXPECT_EQ(found.ridge, 0);
  EXPECT_TRUE(found.flat.empty());
}

// The line through (0,1), (1,2), (2,2), (3,5) by hand: slope 1.2, intercept 0.7.
TEST(Regression, IsTheTextbooksLine) {
  const Regression found = regress(Eigen::Vector4d(0, 1, 2, 3), Eigen::Vector4d(1, 2, 2, 5));
  EXPECT_NEAR(found.weights(0, 0), 1.2, 1e-12);
  EXPECT_NEAR(found.constant[0], 0.7, 1e-12);
}

TEST(Regression, SharesAWeightBetweenTwinsAndLeavesOutWhatIsStill) {
  Eigen::MatrixXd Z(5, 3);
  Z << 1, 1, 4, 2, 2, 4, 3, 3, 4, 5, 5, 4, 8, 8, 4;
  const Eigen::VectorXd Y = 3 * Z.col(0).array() + 2;
  const Regression found = regress(Z, Y);
  EXPECT_EQ(found.flat, std::vector<int>{2});
  EXPECT_EQ(found.weights(0, 2), 0);
  EXPECT_GT(found.ridge, 0);
  EXPECT_NEAR(found.weights(0, 0), 1.5, 1e-6) << "the ridge's least norm";
  EXPECT_NEAR(found.weights(0, 1), 1.5, 1e-6);
  EXPECT_NEAR(found.constant[0], 2, 1e-5);
}

TEST(Regression, WithoutRegressorsIsTheMean) {
  const Regression found = regress(Eigen::MatrixXd(3, 0), Eigen::Vector3d(1, 2, 6));
  EXPECT_NEAR(found.constant[0], 3, 1e-15);
}

// r_1 of 1, -1, 1, -1 about its mean 0 is -3/4, r_2 2/4: Q = 4*6*(0.5625/3 + 0.25/2) = 7.5.
TEST(LjungBox, IsItsFormula) {
  const Eigen::Vector4d series(1, -1, 1, -1);
  const Whiteness found = ljung_box(series, 2, 0);
  EXPECT_NEAR(found.statistic, 7.5, 1e-12);
  EXPECT_EQ(found.degrees, 2);
  EXPECT_NEAR(found.p, std::exp(-7.5 / 2), 1e-10) << "chi-square of two degrees is exponential";
  EXPECT_TRUE(std::isnan(ljung_box(series, 2, 2).p)) << "no degree of freedom is left";
  EXPECT_TRUE(std::isnan(ljung_box(Eigen::Vector4d(2, 2, 2, 2), 2, 0).p)) << "nothing varies";
}

TEST(LjungBox, TellsWhiteFromColoured) {
  const Draws draws(1, "test.whiteness");
  Eigen::VectorXd noise(4000), coloured(4000);
  draws.normals(0, noise);
  coloured[0] = noise[0];
  for (Eigen::Index k = 1; k < noise.size(); ++k) coloured[k] = 0.2 * coloured[k - 1] + noise[k];
  EXPECT_GT(ljung_box(noise, 24, 0).p, 0.001);
  EXPECT_LT(ljung_box(coloured, 24, 0).p, 1e-6);
}

}  // namespace
}  // namespace vigil::identify::regression_test
