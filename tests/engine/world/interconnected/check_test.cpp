// What of a description is refused, and in which words. Specification (observer), section 10.
#include <gtest/gtest.h>

#include <limits>

#include "tests/engine/methods/observer/networks.hpp"

namespace vigil::observer::check_test {
namespace {

Eigen::MatrixXd matrix(std::initializer_list<std::initializer_list<double>> rows) { return Eigen::MatrixXd(rows); }

/// The specification's own undetectable plant.
Network undetectable() {
  Subsystem s;
  s.A = matrix({{-1, 1}, {0, -2}});
  s.C = matrix({{0, 1}});
  s.D = matrix({{1}, {0}});
  complete(s);
  return {.subsystems = {s}};
}

std::vector<NetworkProblem> after(const std::function<void(Network&)>& spoil) {
  Network network = pair().network;
  spoil(network);
  return check(network);
}

/// One problem, of that matrix and subsystem (from 0), that says why.
void expect(const std::vector<NetworkProblem>& problems, const std::string& matrix, int subsystem,
            const std::string& why) {
  ASSERT_EQ(problems.size(), 1U) << matrix << ": " << why;
  EXPECT_EQ(problems[0].matrix, matrix);
  EXPECT_EQ(problems[0].subsystem, subsystem);
  EXPECT_NE(problems[0].reason.find(why), std::string::npos) << problems[0].reason;
}

TEST(CheckOfANetwork, TakesTheExamplesAndMixedSizes) {
  EXPECT_TRUE(check(pair().network).empty());
  EXPECT_TRUE(check(single().network).empty());
  for (const AreaOutputs outputs : {AreaOutputs::case_1, AreaOutputs::case_2}) {
    for (const Topology topology : {Topology::full, Topology::ring}) {
      EXPECT_TRUE(check(areas(outputs, topology).network).empty());
    }
  }
  for (const int k : {1, 2, 4, 8}) EXPECT_TRUE(check(ring(k)).empty());
  for (int number = 0; number < 10; ++number) EXPECT_TRUE(check(mixed(number)).empty()) << number;
}

TEST(CheckOfANetwork, RefusesWhatCannotBeObserved) {
  expect(check(undetectable()), "D", 0, "not observable: invariant zero");
  Network hidden = undetectable();  // an unstable mode that no output shows
  hidden.subsystems[0].A(0, 0) = 1;
  expect(check(hidden), "C", 0, "not observable: invariant zero");
  // Faults in outputs 1 and 3 leave 2, where a constant attack cancels: x2 = w / 2 and x3 = 7 w / 2.
  Network masked = pair().network;
  masked.subsystems[0].G = matrix({{1, 0}, {0, 0}, {0, 1}});
  EXPECT_TRUE(check(masked).empty());
  masked.subsystems[0].C(1, 2) = -1.0 / 7;
  expect(check(masked), "D", 0, "not observable: invariant zero at 0");
}

TEST(CheckOfANetwork, SeesBelowTheRoundingOfAProjection) {
  // The fault hides the unstable first state; what the projection leaves of it is rounding, which sees nothing.
  Subsystem s;
  s.A = matrix({{0.3, 0}, {0, -1}});
  s.C = matrix({{0.7, 0.2}, {1.1, 0.5}});
  s.G = s.C.col(0);
  s.D = matrix({{0}, {1}});
  complete(s);
  expect(check({.subsystems = {s}}), "C", 0, "not observable");
}

TEST(CheckOfANetwork, NamesTheMatrixTheSubsystemAndTheReason) {
  const double infinity = std::numeric_limits<double>::infinity();
  const auto spoil = [](int i, auto change) {
    return after([&](Network& network) { change(network.subsystems[static_cast<std::size_t>(i)]); });
  };
  expect(spoil(1, [](Subsystem& s) { s.A = Eigen::MatrixXd::Zero(3, 4); }), "A", 1, "3 x 4");
  expect(spoil(0, [](Subsystem& s) { s.C = Eigen::MatrixXd::Zero(3, 3); }), "C", 0, "3 x 4 were expected");
  expect(spoil(0,
               [](Subsystem& s) {
                 s.C.resize(0, 4);
                 s.G.resize(0, 0);
                 s.E.resize(0, 0);
               }),
         "C", 0, "at least one output");
  expect(spoil(0, [](Subsystem& s) { s.B = Eigen::MatrixXd::Ones(3, 1); }), "B", 0, "4 rows");
  expect(spoil(0, [](Subsystem& s) { s.F = Eigen::MatrixXd::Ones(5, 1); }), "F", 0, "4 rows");
  expect(spoil(1, [&](Subsystem& s) { s.Dd(1, 0) = infinity; }), "Dd", 1, "not finite");
  expect(spoil(1, [&](Subsystem& s) { s.A(1, 0) = std::nan(""); }), "A", 1, "not finite");
  expect(spoil(0, [](Subsystem& s) { s.D = s.D.replicate(1, 2).eval(); }), "D", 0, "linearly dependent");
  expect(spoil(0, [](Subsystem& s) { s.D.setZero(); }), "D", 0, "linearly dependent");
  expect(spoil(1, [](Subsystem& s) { s.G.setZero(); }), "G", 1, "linearly dependent");
  expect(spoil(1, [](Subsystem& s) { s.G = Eigen::MatrixXd::Identity(3, 3); }), "G", 1,
         "as many faults as there are outputs");
  expect(spoil(1, [](Subsystem& s) { s.C.row(2) = 2 * s.C.row(0); }), "C", 1, "linearly dependent");
  expect(spoil(1, [](Subsystem& s) { s.E(2, 2) = 0; }), "E", 1, "singular");
  expect(spoil(1, [](Subsystem& s) { s.E.resize(2, 2); }), "E", 1, "3 x 3 were expected");
  expect(spoil(0, [](Subsystem& s) { s.tau = -1; }), "tau", 0, "at least 0");
  expect(spoil(0, [](Subsystem& s) { s.kappa = 0; }), "kappa", 0, "above 0");
  expect(spoil(0, [](Subsystem& s) { s.mu = 0; }), "mu", 0, "above 0");
  expect(spoil(0, [&](Subsystem& s) { s.alpha = infinity; }), "alpha", 0, "not finite");
  expect(spoil(0, [](Subsystem& s) { s.varsigma = -1; }), "varsigma", 0, "at least 0");
  expect(spoil(1,
               [](Subsystem& s) {
                 s.name = "pump";
                 s.E(2, 2) = 0;
               }),
         "E", 1, "subsystem pump");
}

TEST(CheckOfANetwork, RefusesCouplingsThatDoNotFit) {
  expect(after([](Network& n) { n.couplings[0].H = Eigen::MatrixXd::Zero(3, 4); }), "H_12", 0, "4 x 3 was expected");
  expect(after([](Network& n) { n.couplings[1].H(0, 0) = std::nan(""); }), "H_21", 1, "not finite");
  expect(after([](Network& n) { n.couplings[0].from = 0; }), "H_11", 0, "itself");
  expect(after([](Network& n) { n.couplings[0].from = 5; }), "H_16", 0, "does not exist");
  expect(after([](Network& n) { n.couplings.push_back(n.couplings[0]); }), "H_12", 0, "twice");
  expect(check({}), "", -1, "without subsystems");
}

TEST(CheckOfANetwork, RefusesSizesThatNoDesignIsFoundFor) {
  Network many;
  many.subsystems.assign(kMaxSize + 1, single().network.subsystems[0]);
  expect(check(many), "", -1, "at most 50");
  Network large = single().network;
  large.subsystems[0].A = -Eigen::MatrixXd::Identity(60, 60);
  expect(check(large), "A", 0, "at most 50");
}

}  // namespace
}  // namespace vigil::observer::check_test
