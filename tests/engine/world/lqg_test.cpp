/// Linear-quadratic feedback: specification of seed 003, section 2.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "engine/world/controller.hpp"
#include "tests/engine/methods/replay/tank.hpp"
#include "tests/engine/methods/rig.hpp"

namespace vigil::lqg_test {
namespace {

std::shared_ptr<const Plant> plant_of(const Json& A, const Json& B) {
  return Registry<PlantMake>::find("linear")->make(rig::completed<PlantMake>("linear", {{"A", A}, {"B", B}}), 1);
}

std::shared_ptr<const Plant> tank() { return plant_of({{1, -0.1}, {0.1, 0.9}}, {{0.7}, {0.3}}); }

std::shared_ptr<const Controller> lqg(const Plant& plant, const Json& params = Json::object()) {
  return Registry<ControllerMake>::find("lqg")->make(rig::completed<ControllerMake>("lqg", params), plant);
}

Eigen::MatrixXd matrix(const Json& rows) {
  Eigen::MatrixXd result(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(rows[0].size()));
  for (Eigen::Index r = 0; r < result.rows(); ++r) {
    for (Eigen::Index c = 0; c < result.cols(); ++c)
      result(r, c) = rows[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)].get<double>();
  }
  return result;
}

Eigen::VectorXd input(const Controller& controller, std::int64_t k, const double* estimate, int inputs = 1) {
  Eigen::VectorXd u(inputs);
  controller.input(k, estimate, u);
  return u;
}

TEST(Lqg, HasTheTanksGainAndPoles) {
  const auto controller = lqg(*tank());
  const Eigen::MatrixXd L = matrix(controller->design()["L"]);
  EXPECT_NEAR(L(0, 0), -0.624, 5e-4);
  EXPECT_NEAR(L(0, 1), -0.298, 5e-4);
  // The fixed point of the equation to 12 digits, by plain iteration.
  const Eigen::MatrixXd &A = replay::tank::A, &B = replay::tank::B;
  Eigen::MatrixXd S = Eigen::MatrixXd::Identity(2, 2), K;
  for (int i = 0; i < 3000; ++i) {
    K = -(B.transpose() * S * B + Eigen::MatrixXd::Identity(1, 1)).inverse() * B.transpose() * S * A;
    S = A.transpose() * S * (A + B * K) + Eigen::MatrixXd::Identity(2, 2);
  }
  EXPECT_LT((L - K).norm(), 1e-12);
  const Eigen::VectorXcd poles = (A + B * L).eigenvalues();
  Eigen::Vector2d moduli = poles.cwiseAbs();
  std::sort(moduli.begin(), moduli.end());
  EXPECT_NEAR(moduli[0], 0.4815, 5e-5);
  EXPECT_NEAR(moduli[1], 0.8923, 5e-5);
  EXPECT_NEAR(controller->design()["spectral_radius"].get<double>(), moduli[1], 1e-12);
}

TEST(Lqg, FeedsTheEstimateBack) {
  const auto controller = lqg(*tank());
  const Eigen::MatrixXd L = matrix(controller->design()["L"]);
  const Eigen::Vector2d x(3, -2);
  EXPECT_NEAR(input(*controller, 7, x.data())[0], (L * x)[0], 1e-14);
  EXPECT_EQ(input(*controller, 7, nullptr)[0], 0) << "before there is an estimate: uref alone";
}

// u = L (xh - xref) + uref with xref = (I - A)^-1 B uref: at xref the input is uref.
TEST(Lqg, FollowsItsReferences) {
  const Eigen::Vector2d steady = (Eigen::Matrix2d::Identity() - replay::tank::A).inverse() * replay::tank::B;
  const auto step = lqg(*tank(), {{"reference", "step"}}), sine = lqg(*tank(), {{"reference", "sine"}});
  const Eigen::MatrixXd L = matrix(step->design()["L"]);
  const auto expect = [&](const Controller& controller, std::int64_t k, double level) {
    const Eigen::Vector2d there = level * steady, off = there + Eigen::Vector2d(0.5, -1);
    EXPECT_NEAR(input(controller, k, there.data())[0], level, 1e-12) << k;
    EXPECT_NEAR(input(controller, k, off.data())[0], level + (L * Eigen::Vector2d(0.5, -1))[0], 1e-12) << k;
    EXPECT_NEAR(input(controller, k, nullptr)[0], level, 1e-13) << k;
  };
  for (const auto& [k, level] : {std::pair{0, 1}, std::pair{100, 1}, std::pair{101, 3}, std::pair{199, 3},
                                 std::pair{200, 2}, std::pair{100000, 2}})
    expect(*step, k, level);
  for (const std::int64_t k : {0, 1, 10, 39, 40, 45, 300})
    expect(*sine, k, 2 * std::sin(2 * std::numbers::pi * static_cast<double>(k) / 40));
}

// Two inputs, weights that differ: the gain solves the equation and stabilises an unstable plant.
TEST(Lqg, TakesUsersMatricesAndWeights) {
  const auto plant = plant_of({{1.2, 0.5, 0}, {0, 0.9, 1}, {0.3, 0, 1.1}}, {{1, 0}, {0, 0.5}, {0.2, 1}});
  const Json weights = {{"Qc", {1, 10, 0.1}}, {"Rc", {{2, 0.5}, {0.5, 1}}}};
  const auto controller = lqg(*plant, weights);
  const LinearModel model = linear_model(*plant);
  const Eigen::MatrixXd L = matrix(controller->design()["L"]);
  const Eigen::MatrixXd Q = Eigen::Vector3d(1, 10, 0.1).asDiagonal();
  const Eigen::Matrix2d R{{2, 0.5}, {0.5, 1}};
  const Eigen::MatrixXd closed = model.A + model.B * L;
  EXPECT_LT(closed.eigenvalues().cwiseAbs().maxCoeff(), 1);
  Eigen::MatrixXd S = Eigen::MatrixXd::Zero(3, 3);  // the cost of this feedback
  for (int i = 0; i < 5000; ++i) S = Q + L.transpose() * R * L + closed.transpose() * S * closed;
  const Eigen::MatrixXd best = -(model.B.transpose() * S * model.B + R).inverse() * model.B.transpose() * S * model.A;
  EXPECT_LT((L - best).norm(), 1e-10 * L.norm()) << "no other feedback costs less";
  const Eigen::Vector3d x(1, -2, 3);
  EXPECT_LT((input(*controller, 3, x.data(), 2) - L * x).norm(), 1e-13);
}

struct Refused {
  Json A, B, params;
  const char* pointer;
  const char* words;
};

TEST(Lqg, RefusesWhatItCannotStabilise) {
  const Json unit = {{1, 0}, {0, 1}};
  const Refused table[] = {
      {{{1.5, 0}, {0, 0.5}}, {{0}, {1}}, Json::object(), "/", "expected a stabilisable pair"},
      {unit, nullptr, Json::object(), "/", "an input"},
      {{{0.9, 0}, {0, 1}}, {{1}, {1}}, {{"reference", "step"}}, "/reference", "an eigenvalue at 1"},
      {unit, unit, {{"Rc", 0}}, "/Rc", "positive definite"},
      {unit, unit, {{"Qc", {{1, 2}, {2, 1}}}}, "/Qc", "negative eigenvalue -1"},
      {unit, unit, {{"Qc", {1, 1, 1}}}, "/Qc", "2"},
      {{{1, 0}, {0, 0.5}}, {{1}, {1}}, {{"Qc", 0}}, "/Qc", "does not weigh a mode on the unit circle"}};
  for (const Refused& row : table) {
    try {
      lqg(*plant_of(row.A, row.B), row.params);
      ADD_FAILURE() << row.words;
    } catch (const InputError& error) {
      EXPECT_EQ(error.problems().front().pointer, row.pointer) << error.what();
      EXPECT_NE(std::string(error.what()).find(row.words), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace vigil::lqg_test
