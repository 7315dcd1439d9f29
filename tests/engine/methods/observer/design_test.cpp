// Designs read from a problem's answer, and what they are accepted on. Specification (observer), sections 6 and 8.
#include <gtest/gtest.h>

#include "engine/core/input_error.hpp"
#include "engine/methods/observer/matched.hpp"
#include "tests/engine/methods/observer/letters.hpp"

namespace vigil::observer::design_test {
namespace {

using Eigen::MatrixXd;

TEST(TheClassicalStructure, HasNoInnovationInTheta) {
  SynthesisOptions options = ref();
  options.structure = Structure::classical;
  const Synthesis synthesis = theorem_1(error_system(single().network), options);
  EXPECT_EQ(synthesis.problem.variables(), 10 + 1 + 12 + 3);
  Eigen::VectorXd y = some_y(synthesis, 1);
  y.tail(3) = y.tail(3).cwiseAbs();                        // squares, and nu
  for (const int place : {0, 4, 7, 9, 10}) y[place] = 10;  // the diagonal of P_xi, and P_theta
  const auto design = read_design(synthesis, y);
  ASSERT_TRUE(design);
  EXPECT_TRUE(design->L[0].row(4).isZero(0));
  EXPECT_TRUE(design->P[0].row(4).head(4).isZero(0));
  EXPECT_FALSE(design->L[0].topRows(4).isZero(1e-3));
  EXPECT_LT(
      distance(blocks_at(synthesis.problem, y)[0], -sigma(synthesis.system, *design) - 1e-3 * MatrixXd::Identity(8, 8)),
      1e-10);
}

/// A y with a definite P, whose design then is the same in both of its forms.
Eigen::VectorXd definite_y(const Synthesis& synthesis, int number) {
  Eigen::VectorXd y = some_y(synthesis, number).cwiseAbs();
  for (std::size_t i = 0; i < synthesis.unknowns.size(); ++i) {
    const auto size = synthesis.system.parts[i].Abar.rows();
    Eigen::Index at = synthesis.unknowns[i].P;
    for (auto column = size; column > 0; at += column--) y[at] += 20;
  }
  return y;
}

TEST(ADesign, IsReadBackFromItsUnknowns) {
  for (const Network& network : {pair().network, mixed(2)}) {
    const Synthesis synthesis = theorem_1(error_system(network), ref());
    const Eigen::VectorXd y = definite_y(synthesis, 3);
    const auto design = read_design(synthesis, y);
    ASSERT_TRUE(design);
    const auto all = letters(synthesis.system, y, false);
    for (std::size_t i = 0; i < all.size(); ++i) {
      EXPECT_EQ(design->P[i], all[i].P);
      EXPECT_LT(distance(design->P[i] * design->L[i], all[i].W), 1e-13);
      EXPECT_DOUBLE_EQ(design->gamma_d[i], std::sqrt(all[i].gd2));
      EXPECT_DOUBLE_EQ(design->gamma_w[i], std::sqrt(all[i].gw2));
      EXPECT_EQ(design->kappa[i], all[i].kappa);
    }
    EXPECT_LT(distance(sigma(synthesis.system, *design), printed_sigma(network, all)), 1e-12);
    EXPECT_DOUBLE_EQ(design->objective, objective(synthesis.problem, y));
    const Synthesis given = certification(synthesis.system, design->L, {.pmin = 1e-2, .pmax = 1e6});
    EXPECT_EQ(given.problem.blocks.size(), 1 + 2 * all.size());
    const Eigen::VectorXd of_given = definite_y(given, 4);
    const auto again = read_design(given, of_given);
    ASSERT_TRUE(again);
    EXPECT_EQ(again->L, design->L);
    EXPECT_LT(distance(blocks_at(given.problem, of_given)[0], -sigma(given.system, *again)), 1e-12);
  }
}

TEST(ADesign, IsNoneWithoutADefiniteP) {
  const Synthesis synthesis = theorem_1(error_system(pair().network), ref());
  Eigen::VectorXd y = definite_y(synthesis, 1);
  EXPECT_FALSE(read_design(synthesis, y.head(74)));
  EXPECT_FALSE(read_design(synthesis, Eigen::VectorXd()));
  y[3] = NAN;
  EXPECT_FALSE(read_design(synthesis, y));
  y = definite_y(synthesis, 1);
  y[0] = -1;
  EXPECT_FALSE(read_design(synthesis, y));
}

TEST(ADesign, ComesBackEqualFromJson) {
  const Synthesis synthesis = theorem_1(error_system(mixed(2)), ref());
  const Design design = *read_design(synthesis, definite_y(synthesis, 3));
  const Design back = read_design(Json::parse(to_json(design).dump()), "/design");
  EXPECT_EQ(back.L, design.L);
  EXPECT_EQ(back.P, design.P);
  EXPECT_EQ(back.gamma_d, design.gamma_d);
  EXPECT_EQ(back.gamma_w, design.gamma_w);
  EXPECT_EQ(back.kappa, design.kappa);
  EXPECT_EQ(back.objective, design.objective);
  for (const char* spoil : {"/L/0/0/0", "/P/1", "/kappa", "/gamma_d/0", "/L"}) {
    Json bad = to_json(design);
    bad[Json::json_pointer(spoil)] = "x";
    EXPECT_THROW(read_design(bad, "/design"), InputError) << spoil;
  }
  Json bad = to_json(design);
  bad["L"][0].erase(0);
  EXPECT_THROW(read_design(bad, "/design"), InputError);
  bad = to_json(design);
  bad["L"].erase(0);
  EXPECT_THROW(read_design(bad, "/design"), InputError);
}

TEST(ACertificate, IsRefusedWhereSomethingDoesNotHold) {
  // e' = -e by hand: A = -1, no input; Sigma = 2 P A - 2 W + 1 = 1 - 2 P (1 + L).
  Subsystem s;
  s.A = MatrixXd::Constant(1, 1, -1);
  s.C = MatrixXd::Constant(1, 1, 1);
  complete(s);
  const ErrorSystem system = error_system({.subsystems = {s}});
  const Synthesis synthesis = theorem_1(system, ref());
  EXPECT_EQ(synthesis.problem.variables(), 3);  // P, W, nu
  const auto certificate = [&](double P, double W, double nu) {
    const Eigen::VectorXd y = Eigen::Vector3d(P, W, nu);
    return certify(synthesis, *read_design(synthesis, y), y);
  };
  const Certificate good = certificate(1, 2, 4);
  EXPECT_TRUE(good.holds) << good.reason;
  EXPECT_DOUBLE_EQ(good.lambda_max_sigma, -5);
  EXPECT_DOUBLE_EQ(good.lambda_min_p, 1);
  EXPECT_DOUBLE_EQ(good.max_real_pole, -3);
  EXPECT_DOUBLE_EQ(good.fastest_pole, 3);
  EXPECT_DOUBLE_EQ(good.norm_l[0], 2);
  const std::vector<double> margins = {5 - 1e-3, 1 - 1e-2, 1e4 - 1, 2.5 - std::sqrt(2.25 + 4)};
  ASSERT_EQ(good.margins.size(), 4U);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(good.margins[k], margins[k], 1e-12);
  const Certificate weak = certificate(0.1, 0, 1);
  EXPECT_FALSE(weak.holds);
  EXPECT_NEAR(weak.lambda_max_sigma, 0.8, 1e-12);
  EXPECT_NE(weak.reason.find("Sigma"), std::string::npos);
  EXPECT_FALSE(certificate(0.5 + 1e-4, 0, 1).holds);  // -2e-4 is above -eps/2
  EXPECT_TRUE(certificate(0.5 + 3e-4, 0, 1).holds);
  EXPECT_EQ(to_json(good)["holds"], true);
  EXPECT_EQ(to_json(good)["poles"], Json::array({Json::array({-3.0, 0.0})}));
  const Certificate poles = poles_only(system, {MatrixXd::Constant(1, 1, NAN)});
  EXPECT_FALSE(poles.holds);
  EXPECT_TRUE(to_json(poles)["max_real_pole"].is_null());
}

TEST(TheMatchedObserver, ExistsWhereTheOutputsSeeTheAttackAtOnce) {
  for (const auto& [outputs, even] : {std::pair{AreaOutputs::case_1, true}, {AreaOutputs::case_2, false}}) {
    const Network network = areas(outputs).network;
    for (std::size_t i = 0; i < 4; ++i) {
      const Subsystem& s = network.subsystems[i];
      const bool expected = i % 2 == 0 || even;
      EXPECT_EQ(matching_condition(s), expected);
      const Matching m = matching(s);
      EXPECT_EQ(m.holds, expected);
      if (expected) {
        EXPECT_LT((m.projection * s.D).norm(), 1e-14);  // the attack does not enter the error
      } else {
        EXPECT_EQ(m.projection, MatrixXd::Identity(4, 4));
      }
    }
    const Synthesis synthesis = theorem_1(matched_error_system(network), matched());
    EXPECT_EQ(synthesis.problem.blocks, (std::vector<int>{16, 4, 4, 4, 4, 4, 4, 4, 4, 7, 7, 7, 7}));
    EXPECT_EQ(synthesis.problem.variables(), 4 * (10 + 12 + 1));
  }
}

}  // namespace
}  // namespace vigil::observer::design_test
