#include "engine/methods/privacy/secrecy_code.hpp"

#include <gtest/gtest.h>

namespace vigil::privacy::secrecy_code_test {
namespace {

using Eigen::MatrixXd;

// Section 4.7, with 0.36 of the messages missed; at the ends: all heard, and none.
TEST(PrivacySecrecy, CodeAOnTheEngine) {
  const FusionModel model = engine_model();
  const auto filters = stationary_filters(model);
  const Fusion nominal = fuse(filters->P, 3);
  EXPECT_NEAR(code_a_eavesdropper(model, *filters, nominal, 0.36)->trace(), 0.08961, 5.1e-6);
  EXPECT_LE((*code_a_eavesdropper(model, *filters, nominal, 0) - nominal.P).norm(), 1e-14);
  const MatrixXd S = *state_covariance(model);
  EXPECT_LE((*code_a_eavesdropper(model, *filters, nominal, 1) - S).norm(), 1e-9 * S.norm());
  const auto robot = stationary_filters(linear_robot());
  EXPECT_FALSE(code_a_eavesdropper(linear_robot(), *robot, fuse(robot->P, 2), 0.36));
}

// E[(xhat+ - Lc xhat) xhat+'] = S_i - Lc S_i A' = 0.
TEST(PrivacySecrecy, CodeLIsUncorrelatedWithTheNewestEstimate) {
  const FusionModel model = engine_model();
  const auto filters = stationary_filters(model);
  const auto codes = code_l(model, *filters);
  ASSERT_TRUE(codes);
  for (int i = 0; i < 2; ++i) {
    const MatrixXd Si = *state_covariance(model) - filters->P.block(3 * i, 3 * i, 3, 3);
    EXPECT_LE((Si - (*codes)[static_cast<std::size_t>(i)] * Si * model.A.transpose()).norm(), 1e-10 * Si.norm());
  }
  EXPECT_FALSE(code_l(linear_robot(), *stationary_filters(linear_robot())));
}

}  // namespace
}  // namespace vigil::privacy::secrecy_code_test
