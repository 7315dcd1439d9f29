/// The mixed estimator over a record: beside a dense pass in extended precision, through gaps, without a prior.
#include "tests/engine/methods/replay/filter_rig.hpp"
#include "tests/engine/methods/replay/plain_filters.hpp"

namespace vigil::replay::filters_mixed_test {
namespace {

constexpr int kTicks = 30;

/// Three states, two channels and two inputs; the sensor's bounded noise is large, so that the optimum lies inside.
System system_of(std::uint64_t seed = 1) {
  RandomMatrices random(static_cast<std::int64_t>(seed));
  System s;
  s.A = Eigen::Matrix3d{{0.9, 0.2, -0.1}, {0, 1.02, 0.3}, {0.2, -0.2, 0.7}};
  s.B = Eigen::MatrixXd{{1, 0}, {0, 0.5}, {0.3, -1}};
  s.C = Eigen::MatrixXd{{1, 0, 0.5}, {0.2, 1, 0}};
  s.P = 0.1 * random.definite(3);
  s.R = 0.1 * random.definite(2);
  s.Mw = 0.1 * random.definite(3);
  s.Mv = 0.3 * random.definite(2);
  return s;
}

void expect_near(double ours, plain::Real expected, double tolerance, const std::string& what) {
  const double size = std::max(1.0, std::abs(static_cast<double>(expected)));
  ASSERT_NEAR(ours, static_cast<double>(expected), tolerance * size) << what;
}

void expect_state(const rig::Signals& signals, const Method& method, const plain::Mixed& plain, int k) {
  const std::string at = " at " + std::to_string(k);
  const Eigen::VectorXd x = rig::estimate(method, 3);
  for (int c = 0; c < 3; ++c) expect_near(x[c], plain.x[c], 1e-8, "estimate" + at);
  for (int a = 0; a < 3; ++a) {
    for (int b = a; b < 3; ++b) {
      const std::string place = ".x" + std::to_string(a + 1) + ".x" + std::to_string(b + 1);
      expect_near(signals("covariance" + place), plain.sets.Q(a, b), 1e-8, "covariance" + place + at);
      expect_near(signals("shape" + place), plain.sets.M(a, b), 1e-8, "shape" + place + at);
    }
  }
}

using plain::real;

plain::Mixed started(const plain::Model& model, const rig::Record& record, int end) {
  std::vector<plain::Vector> y, u;
  for (int k = end - 3; k < end; ++k) {
    y.push_back(real(record.y[static_cast<std::size_t>(k)]));
    u.push_back(real(record.u[static_cast<std::size_t>(k)]));
  }
  plain::Mixed mixed;
  mixed.x = plain::fitted(model, y, u);
  mixed.sets = plain::first_sets(model);
  return mixed;
}

TEST(MixedFilter, PassesARecordAsTheDenseFormulas) {
  for (const double mu : {0.0, 0.3, 0.8}) {
    const System system = system_of();
    const plain::Model model(system);
    const rig::Record record = rig::record_of(system, kTicks, 77);
    const auto method = rig::make("mixed_filter", rig::knowledge_of(system), {{"mu", mu}});
    const rig::Signals signals(*method);
    FaultTable faults;
    plain::Mixed plain;
    for (int k = 1; k <= kTicks; ++k) {
      SCOPED_TRACE("mu " + std::to_string(mu) + ", tick " + std::to_string(k));
      const auto i = static_cast<std::size_t>(k - 1);
      rig::tick(*method, record.y[i], record.u[i], faults, k);
      EXPECT_EQ(method->ready(), k >= 3);
      if (k < 3) continue;
      if (k == 3) {
        plain = started(model, record, 3);
      } else {
        plain.step(model, mu, real(record.u[i]), real(record.y[i]));
        ASSERT_GT(plain.zeta, 1e-3L);
        ASSERT_LT(plain.zeta, 1e3L) << "not a corner";
        expect_near(signals("zeta"), plain.zeta, 1e-6, "zeta");
        const plain::Vector r = plain::residual(model, real(record.y[i]), plain.x);
        for (int c = 0; c < 2; ++c) expect_near(signals("residual.y" + std::to_string(c + 1)), r[c], 1e-8, "residual");
      }
      expect_state(signals, *method, plain, k);
      if (testing::Test::HasFatalFailure()) return;
    }
    EXPECT_TRUE(vigil::rig::faults_of(faults, *method).empty());
  }
}

// Section 10: a missing reading leaves the prediction, Q = Qp and M = Mp; the gains are computed on line from there on.
TEST(MixedFilter, HoldsWhereAReadingIsMissing) {
  const System system = system_of();
  const plain::Model model(system);
  rig::Record record = rig::record_of(system, kTicks, 78);
  const auto hole = [](int k) { return k == 9 || k == 14 || k == 15; };
  record.y[8][1] = std::numeric_limits<double>::quiet_NaN();
  record.y[13][0] = std::numeric_limits<double>::infinity();
  record.y[14].setConstant(std::numeric_limits<double>::quiet_NaN());
  const Json params = {{"mu", 0.4}, {"window", 2}, {"tau", 3}, {"eta", 0.1}};
  const auto method = rig::make("mixed_filter", rig::knowledge_of(system), params);
  const rig::Signals signals(*method);
  FaultTable faults;
  plain::Mixed plain;
  for (int k = 1; k <= kTicks; ++k) {
    const auto i = static_cast<std::size_t>(k - 1);
    rig::tick(*method, record.y[i], record.u[i], faults, k);
    if (k < 3) continue;
    if (k == 3) {
      plain = started(model, record, 3);
    } else if (hole(k)) {
      plain.coast(model, real(record.u[i]));
      EXPECT_FALSE(method->detection(0).alarm || method->detection(0).judged) << k;
      EXPECT_TRUE(std::isnan(method->detection(0).statistic) && std::isnan(signals("residual.y1"))) << k;
    } else {
      plain.step(model, 0.4L, real(record.u[i]), real(record.y[i]));
      EXPECT_EQ(std::isfinite(method->detection(0).statistic), k >= 5) << "xi goes on where it stood: " << k;
    }
    expect_state(signals, *method, plain, k);
    if (testing::Test::HasFatalFailure()) return;
  }
  const auto told = vigil::rig::faults_of(faults, *method);
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].code, "no_reading");
  EXPECT_EQ(told[0].count, 3);
  EXPECT_EQ(told[0].first, 9);
}

// The start batch waits for n good samples in a row.
TEST(MixedFilter, StartsWhenEnoughGoodReadingsCameInARow) {
  const System system = system_of();
  const plain::Model model(system);
  rig::Record record = rig::record_of(system, kTicks, 79);
  record.y[1][0] = std::numeric_limits<double>::quiet_NaN();  // ticks 2 and 5
  record.y[4][1] = std::numeric_limits<double>::quiet_NaN();
  const auto method = rig::make("mixed_filter", rig::knowledge_of(system), {{"mu", 0.4}});
  const rig::Signals signals(*method);
  FaultTable faults;
  plain::Mixed plain;
  for (int k = 1; k <= kTicks; ++k) {
    const auto i = static_cast<std::size_t>(k - 1);
    rig::tick(*method, record.y[i], record.u[i], faults, k);
    EXPECT_EQ(method->ready(), k >= 8) << "6, 7 and 8 are good";
    if (k < 8) continue;
    if (k == 8) {
      plain = started(model, record, 8);
    } else {
      plain.step(model, 0.4L, real(record.u[i]), real(record.y[i]));
    }
    EXPECT_EQ(std::isfinite(signals("residual.y1")), k > 8);
    expect_state(signals, *method, plain, k);
    if (testing::Test::HasFatalFailure()) return;
  }
}

// The innovation is that of the same pass, before the update.
TEST(MixedFilter, JudgesTheResidualItIsToldTo) {
  const System system = system_of();
  const rig::Record record = rig::record_of(system, kTicks, 80);
  const auto posterior = rig::make("mixed_filter", rig::knowledge_of(system), {{"mu", 0.4}}),
             prior = rig::make("mixed_filter", rig::knowledge_of(system), {{"mu", 0.4}, {"residual", "innovation"}});
  const rig::Signals of_posterior(*posterior), of_prior(*prior);
  FaultTable faults, more;
  for (int k = 1; k <= kTicks; ++k) {
    const auto i = static_cast<std::size_t>(k - 1);
    const Eigen::VectorXd before = rig::estimate(*posterior, 3);
    rig::tick(*posterior, record.y[i], record.u[i], faults, k);
    rig::tick(*prior, record.y[i], record.u[i], more, k);
    EXPECT_EQ(rig::estimate(*posterior, 3), rig::estimate(*prior, 3));
    if (k < 4) continue;
    const Eigen::VectorXd z = record.y[i] - system.C * (system.A * before + system.B * record.u[i]);
    const Eigen::VectorXd r = record.y[i] - system.C * rig::estimate(*posterior, 3);
    for (int c = 0; c < 2; ++c) {
      EXPECT_NEAR(of_prior("residual.y" + std::to_string(c + 1)), z[c], 1e-12);
      EXPECT_NEAR(of_posterior("residual.y" + std::to_string(c + 1)), r[c], 1e-12);
    }
  }
}

// A copy goes on with its own memory.
TEST(MixedFilter, IsCopiedWhole) {
  const System system = system_of();
  const rig::Record record = rig::record_of(system, kTicks, 81);
  const auto method = rig::make("mixed_filter", rig::knowledge_of(system), {{"tau", 5}, {"threshold", "frozen"}});
  FaultTable faults;
  std::unique_ptr<Method> copy;
  for (int k = 1; k <= kTicks; ++k) {
    const auto i = static_cast<std::size_t>(k - 1);
    if (k == 14) copy = method->clone();
    rig::tick(*method, record.y[i], record.u[i], faults, k);
    if (k < 14) continue;
    rig::tick(*copy, record.y[i], record.u[i], faults, k);
    EXPECT_EQ(rig::estimate(*method, 3), rig::estimate(*copy, 3));
    EXPECT_EQ(method->detection(0).statistic, copy->detection(0).statistic);
    EXPECT_EQ(method->detection(0).threshold, copy->detection(0).threshold);
  }
}

}  // namespace
}  // namespace vigil::replay::filters_mixed_test
