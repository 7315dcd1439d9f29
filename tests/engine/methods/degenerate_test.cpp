/// Bad luck and corner cases of the consensus filter: section 13.
#include <gtest/gtest.h>

#include "tests/engine/methods/rig.hpp"

namespace vigil::degenerate_test {
namespace {

Knowledge default_knowledge(const char* graph = "ladder") {
  return rig::knowledge_of(Scenario::preset("consensus").with("network.graph", graph), 2);
}

std::unique_ptr<Method> filter(const Knowledge& known, const Json& params = Json::object()) {
  return consensus::make_filter(rig::completed("consensus_ekf", params), known);
}

const Eigen::Vector3d kTruth(158, 70, 9.167);

Readings nothing(const Knowledge& known) {
  Readings readings;
  for (const auto& sensor : known.sensors)
    readings.emplace_back(Eigen::VectorXd::Constant(sensor->size(), std::nan("")));
  return readings;
}

TEST(Degenerate, AMissingReadingMeansNoGain) {
  const Knowledge known = default_knowledge("none");
  auto method = filter(known);
  FaultTable faults;
  rig::tick(*method, known, nothing(known), rig::Links(known), faults, 1);
  for (int i = 0; i < 8; ++i) {
    Eigen::VectorXd predicted(3);
    known.plant->advance(known.estimates.col(i), Eigen::VectorXd(0), predicted);
    EXPECT_EQ(rig::mean(*method, i, 3), predicted);
    EXPECT_EQ(method->belief(i).innovation, nullptr);
  }
  Readings half = rig::readings_at(known, kTruth, 1, 2);
  half[3][1] = std::nan("");  // one row missing is the whole reading missing
  auto twin = filter(known);
  FaultTable twin_faults;
  rig::tick(*twin, known, half, rig::Links(known), twin_faults, 1);
  EXPECT_EQ(rig::mean(*twin, 3, 3), rig::mean(*method, 3, 3));
  EXPECT_EQ(rig::bound(*twin, 3, 3), rig::bound(*method, 3, 3));
  EXPECT_NE(rig::mean(*twin, 4, 3), rig::mean(*method, 4, 3));
}

// A node without neighbours: m0 = 1, the other terms vanish. With U and V nearly zero and sigma, beta small it is the
// ordinary filter.
TEST(Degenerate, ALoneNodeIsAnOrdinaryFilter) {
  Knowledge known = default_knowledge("none");
  auto lone = filter(known, {{"sigma", 1e-9}, {"beta", 1e-9}, {"U", 0}, {"V", 0}});
  auto ordinary = Registry<MethodMake>::find("local_ekf")->make(rig::completed("local_ekf"), known);
  FaultTable faults, other;
  Eigen::VectorXd truth = Eigen::Vector3d(150, 70, 0), next(3);
  for (int k = 1; k <= 20; ++k) {
    known.plant->advance(truth, Eigen::VectorXd(0), next);
    truth = next;
    const Readings readings = rig::readings_at(known, truth, 4, k);
    rig::tick(*lone, known, readings, rig::Links(known), faults, k);
    rig::tick(*ordinary, known, readings, rig::Links(known), other, k);
  }
  for (int i = 0; i < 8; ++i) {
    EXPECT_LT((rig::mean(*lone, i, 3) - rig::mean(*ordinary, i, 3)).norm(), 1e-4);
    EXPECT_TRUE(rig::bound(*lone, i, 3).isApprox(rig::bound(*ordinary, i, 3), 1e-4));
  }
}

TEST(Degenerate, AllLinksJammedLeavesBAtTheIdentity) {
  const Knowledge known = default_knowledge();
  rig::Links jammed(known);
  jammed.state.assign(jammed.state.size(), LinkState::dos);
  auto with = filter(known), without = filter(known, {{"tau", 0}});
  FaultTable faults, other;
  const Readings readings = rig::readings_at(known, kTruth, 1, 1);
  rig::tick(*with, known, readings, jammed, faults, 1);
  rig::tick(*without, known, readings, jammed, other, 1);
  for (int i = 0; i < 8; ++i) EXPECT_LT((rig::mean(*with, i, 3) - rig::mean(*without, i, 3)).norm(), 1e-12);
}

TEST(Degenerate, SingularNoiseIsLegal) {
  for (const bool certain_start : {false, true}) {
    Knowledge known = default_knowledge();
    known.Q = Eigen::Vector3d(1, 0, 0).asDiagonal();
    if (certain_start) known.P0.setZero();
    auto method = filter(known);
    FaultTable faults;
    for (int k = 1; k <= 10; ++k)
      rig::tick(*method, known, rig::readings_at(known, kTruth, 1, k), rig::Links(known), faults, k);
    EXPECT_FALSE(faults.stopped());
    for (int i = 0; i < 8; ++i)
      EXPECT_TRUE(rig::mean(*method, i, 3).allFinite() && rig::bound(*method, i, 3).allFinite());
    const auto first = method->metrics().front();
    EXPECT_EQ(first.name, "first_infeasible_step");
    if (certain_start) {
      EXPECT_EQ(first.value, 1) << "a singular Phi0 violates (28) at step 1";
    }
  }
}

TEST(Degenerate, ACameraAtTheRobotIsFine) {
  Knowledge known = default_knowledge();
  known.estimates.colwise() = Eigen::Vector3d(60 - 8, 60, 0);  // predicted exactly under camera 1
  auto method = filter(known);
  FaultTable faults;
  for (int k = 1; k <= 3; ++k)
    rig::tick(*method, known, rig::readings_at(known, Eigen::Vector3d(60, 60, 9), 1, k), rig::Links(known), faults, k);
  EXPECT_FALSE(faults.stopped());
  EXPECT_TRUE(rig::mean(*method, 0, 3).allFinite());
}

TEST(Strict, StopsWithASentenceThatNamesEverything) {
  const Knowledge known = default_knowledge();
  auto method = filter(known, {{"guard", "strict"}});
  FaultTable table;
  int k = 0;
  while (!table.stopped() && k < 10) {
    ++k;
    rig::tick(*method, known, rig::readings_at(known, kTruth, 1, k), rig::Links(known), table, k);
  }
  EXPECT_EQ(k, 2);
  const auto faults = rig::faults_of(table, *method);
  ASSERT_FALSE(faults.empty());
  EXPECT_EQ(faults[0].code, "infeasible_28");
  EXPECT_TRUE(faults[0].stopped);
  EXPECT_EQ(faults[0].node, "1");
  EXPECT_EQ(faults[0].first, 2);
  for (const char* part : {"(28)", "node 1", "step 2", "eigenvalue 1", "limit 7.69231"}) {
    EXPECT_NE(faults[0].detail.find(part), std::string::npos) << faults[0].detail;
  }
}

// At the limit itself the formula divides by zero: that is still (28) failing, not a mystery.
TEST(Strict, NamesTheConditionAtTheVeryLimit) {
  Knowledge known = default_knowledge();
  const Json params = {{"guard", "strict"}, {"sigma", 0.125}, {"eps", 0.25}};
  known.P0 = 6.4 * Eigen::Matrix3d::Identity();
  ASSERT_EQ(1 - 1.25 * 0.125 * 6.4, 0);
  auto method = filter(known, params);
  FaultTable table;
  rig::tick(*method, known, rig::readings_at(known, kTruth, 1, 1), rig::Links(known), table, 1);
  const auto faults = rig::faults_of(table, *method);
  ASSERT_FALSE(faults.empty());
  EXPECT_EQ(faults[0].code, "infeasible_28");
  EXPECT_TRUE(faults[0].stopped);
}

TEST(None, DivergesWithoutCrashingAndSaysSo) {
  const Knowledge known = default_knowledge("complete");
  auto method = filter(known, {{"guard", "none"}, {"tau", 30}, {"eps", 0.1}});
  FaultTable table;
  int k = 0;
  for (; k < 5000 && !table.stopped(); ++k) {
    rig::tick(*method, known, rig::readings_at(known, kTruth, 1, k), rig::attacked(known, 1, k, 0.2, 0.2, 1.5), table,
              k);
  }
  ASSERT_TRUE(table.stopped());
  const auto faults = rig::faults_of(table, *method);
  const auto last = std::find_if(faults.begin(), faults.end(), [](const FaultCount& fault) { return fault.stopped; });
  ASSERT_NE(last, faults.end());
  EXPECT_EQ(last->code, "diverged");
  EXPECT_NE(last->detail.find("step"), std::string::npos);
  EXPECT_FALSE(last->node.empty());
}

struct BadParams {
  Json params;
  const char* pointer;
};

TEST(Settings, AreRefusedAtTheirPointer) {
  Knowledge known = default_knowledge();
  rig::set_rates(known, {0.2, 0.2, 2.0});
  const std::vector<BadParams> bad{
      {{{"eps", 1.0 / 3 + 1e-12}}, "/eps"},
      {{{"eps", 5}}, "/eps"},
      {{{"eps", 0}}, "/eps"},
      {{{"eps", -0.1}}, "/eps"},
      {{{"sigma", 0}}, "/sigma"},
      {{{"beta", -1}}, "/beta"},
      {{{"rho", 1}}, "/rho"},
      {{{"rho", 0}}, "/rho"},
      {{{"tau", -1e-9}}, "/tau"},
      {{{"guard", "clamp"}}, "/guard"},
      {{{"bound", "loose"}}, "/bound"},
      {{{"phibar", 1.5}}, "/phibar"},
      {{{"phibar", 0.7}, {"gammabar", 0.4}}, "/gammabar"},
      {{{"delta", 1.9}}, "/delta"},
      {{{"U", {1, 2}}}, "/U"},
      {{{"V", Json::parse("[[1,0,0],[0,1,0],[0,0,1]]")}}, "/V"},
      {{{"tua", 0.1}}, "/tua"},
      {{{"tau", "0.1"}}, "/tau"},
  };
  for (const BadParams& given : bad) {
    try {
      filter(known, given.params);
      ADD_FAILURE() << given.params;
    } catch (const InputError& error) {
      EXPECT_EQ(error.problems().front().pointer, given.pointer) << given.params << error.what();
    }
  }
  EXPECT_NO_THROW(filter(known, {{"delta", 1.9985}}));  // rounded down by less than 0.1 %
  EXPECT_NO_THROW(filter(known, {{"eps", 0.333}}));
  EXPECT_NO_THROW(filter(default_knowledge("none"), {{"eps", 40}}));  // no edge, no limit
}

TEST(Settings, ChooseEpsByTheGraph) {
  const std::vector<std::pair<const char*, double>> known{
      {"ladder", 0.3}, {"ring", 0.45}, {"complete", 0.9 / 7}, {"none", 0.3}, {"knn3", 0.225}};
  for (const auto& [graph, eps] : known)
    EXPECT_DOUBLE_EQ(filter(default_knowledge(graph))->design()["eps"].get<double>(), eps) << graph;
}

// A live change that is refused must leave no trace.
TEST(Settings, ARefusedRetuneChangesNothing) {
  Knowledge known = default_knowledge();
  auto method = filter(known), twin = filter(known);
  EXPECT_THROW(method->retune(rig::completed("consensus_ekf", {{"eps", 0.9}, {"tau", 0.5}})), InputError);
  EXPECT_THROW(method->retune(rig::completed("consensus_ekf", {{"V", {1, 2, 3}}, {"tau", 0.5}})), InputError);
  auto strict_eps = filter(known, {{"eps", 0.33}});
  const Graph complete = default_knowledge("complete").graph;
  EXPECT_THROW(strict_eps->rewire(complete, std::vector<LinkRates>(complete.links().size())), InputError);
  FaultTable faults, other;
  rig::tick(*method, known, rig::readings_at(known, kTruth, 1, 1), rig::Links(known), faults, 1);
  rig::tick(*twin, known, rig::readings_at(known, kTruth, 1, 1), rig::Links(known), other, 1);
  rig::tick(*strict_eps, known, rig::readings_at(known, kTruth, 1, 1), rig::Links(known), other, 1);
  for (int i = 0; i < 8; ++i) EXPECT_EQ(rig::mean(*method, i, 3), rig::mean(*twin, i, 3));
}

}  // namespace
}  // namespace vigil::degenerate_test
