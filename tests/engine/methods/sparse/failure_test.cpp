/// What the filter does where something fails or cannot be done: specification of seed 001, section 15.
#include <gtest/gtest.h>

#include "engine/methods/sparse/filter.hpp"
#include "tests/engine/methods/sparse/target.hpp"

namespace vigil::failure_test {
namespace {

using target::known;
using target::method;
using target::Target;

/// Fails at node 3 of five, whose turn is the third of every tick.
class Stubborn final : public sparse::Reconstructor {
 public:
  Stubborn(const Params& params, const sparse::WindowShape& shape) : inner_(sparse::make_omp(params, shape)) {}
  std::unique_ptr<sparse::Reconstructor> clone() const override { return inner_->clone(); }
  bool solve(const sparse::Regression& regression, Eigen::Ref<Eigen::VectorXd> E) override {
    const bool solved = inner_->solve(regression, E);
    if (++calls_ % 5 != 3) return solved;
    E.setZero();
    return false;
  }

 private:
  std::unique_ptr<sparse::Reconstructor> inner_;
  int calls_ = 0;
};

std::unique_ptr<sparse::Reconstructor> make_stubborn(const Params& params, const sparse::WindowShape& shape) {
  return std::make_unique<Stubborn>(params, shape);
}

TEST(SparseFilter, GoesOnWhereASolverFails) {
  const Knowledge knowledge = known();
  const Params params = rig::completed("omp_game");
  sparse::SparseFilter stubborn(params, knowledge, make_stubborn, false);
  auto good = method("omp_ekf", knowledge), none = method("window_ekf", knowledge, {{"startup", "predict"}});
  sparse::SparseFilter playing(params, knowledge, make_stubborn, true);
  Target world(knowledge);
  FaultTable faults, others, played;
  for (int k = 1; k <= 30; ++k) {
    const Readings readings = world.next({2});
    rig::tick(stubborn, knowledge, readings, rig::Links(knowledge), faults, k);
    rig::tick(playing, knowledge, readings, rig::Links(knowledge), played, k);
    rig::tick(*good, knowledge, readings, rig::Links(knowledge), others, k);
    rig::tick(*none, knowledge, readings, rig::Links(knowledge), others, k);
    for (const int i : {0, 1, 3, 4}) EXPECT_EQ(rig::mean(stubborn, i, 6), rig::mean(*good, i, 6)) << i;
    EXPECT_EQ(rig::mean(stubborn, 2, 6), rig::mean(*none, 2, 6)) << "nothing is taken off";
    const double* E = stubborn.reconstruction(2).entries;
    EXPECT_EQ(E == nullptr, k < 6);
    EXPECT_TRUE(E == nullptr || Eigen::Map<const Eigen::VectorXd>(E, 36).isZero(0));
    for (int i = 0; i < 5; ++i) EXPECT_TRUE(rig::mean(playing, i, 6).allFinite());
  }
  for (const FaultTable* table : {&faults, &played}) {
    const auto told = rig::faults_of(*table, stubborn);
    ASSERT_EQ(told.size(), 1U);
    EXPECT_EQ(told[0].code, "unsolved");
    EXPECT_EQ(told[0].node, "3");
    EXPECT_EQ(told[0].first, 6);
    EXPECT_EQ(told[0].count, 25);
    EXPECT_FALSE(told[0].stopped);
    EXPECT_NE(told[0].detail.find("node 3"), std::string::npos);
  }
}

TEST(SparseFilter, FlagsAWindowThatDoesNotDetermineTheState) {
  const Json still = {{"poles_x", {1, 0}}, {"poles_y", {1, 0}}, {"poles_z", {1, 0}}};
  Knowledge knowledge = known(
      {{"plant", {{"params", still}}}, {"nodes", {{"3", {{"sensor", {{"params", {{"position", {10, 10, 0}}}}}}}}}}});
  auto filter = method("omp_game", knowledge, {{"T", 1}, {"beta", 0}});
  FaultTable faults;
  const Readings readings = rig::readings_at(knowledge, knowledge.estimates.col(0), 1, 1);
  rig::tick(*filter, knowledge, readings, rig::Links(knowledge), faults, 1);
  EXPECT_EQ(filter->choice(2), -1);
  EXPECT_GE(filter->choice(0), 0);
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(rig::mean(*filter, i, 6).allFinite());
  std::vector<std::string> codes;
  for (const FaultCount& fault : rig::faults_of(faults, *filter)) {
    EXPECT_EQ(fault.node, "3");
    EXPECT_FALSE(fault.stopped);
    codes.push_back(fault.code);
  }
  EXPECT_EQ(codes, (std::vector<std::string>{"singular_geometry", "unobservable"}));
}

TEST(SparseFilter, StopsWhenItIsNoLongerFinite) {
  const Knowledge knowledge = known({{"plant", {{"params", {{"poles_x", {1.6, 0}}}}}}});
  for (const char* id : {"omp_game", "window_ekf", "l1_ekf"}) {
    auto filter = method(id, knowledge);
    const Readings nothing(5, Eigen::VectorXd::Constant(6, std::nan("")));
    FaultTable faults;
    int k = 0;
    while (!faults.stopped() && ++k < 5000) {
      rig::tick(*filter, knowledge, nothing, rig::Links(knowledge), faults, k);
      ASSERT_TRUE(faults.stopped() || rig::bound(*filter, 4, 6).allFinite()) << id << " at " << k;
    }
    const auto told = rig::faults_of(faults, *filter);
    ASSERT_EQ(told.size(), 1U) << id;
    EXPECT_EQ(told[0].code, "diverged");
    EXPECT_TRUE(told[0].stopped);
  }
}

TEST(SparseFilter, RefusesWhatItCannotDo) {
  const auto pointer = [](const char* id, const Knowledge& knowledge, const Json& params) {
    try {
      method(id, knowledge, params);
    } catch (const InputError& error) {
      return error.problems().front().pointer + " " + error.problems().front().allowed;
    }
    return std::string("accepted");
  };
  const Knowledge knowledge = known();
  for (const char* id : {"omp_game", "omp_ekf", "l1_ekf", "etpg_ekf", "omp_game_channels", "window_ekf"}) {
    EXPECT_EQ(pointer(id, knowledge, {{"q", 7}}), "/q 0 to 6") << id;
    EXPECT_EQ(pointer(id, knowledge, {{"q", -1}}).substr(0, 2), "/q") << id;
    EXPECT_EQ(pointer(id, knowledge, {{"T", 0}}).substr(0, 2), "/T") << id;
    EXPECT_EQ(pointer(id, knowledge, {{"startup", "wait"}}).substr(0, 8), "/startup") << id;
    EXPECT_EQ(pointer(id, knowledge, {{"q", 6}, {"T", 1}}), "accepted") << id;
    EXPECT_EQ(pointer(id, rig::knowledge_of(Scenario::preset("consensus")), Json::object()).substr(0, 2), "/T")
        << id << ": a robot's turn is not linear";
  }
}

}  // namespace
}  // namespace vigil::failure_test
