/// The plain unbiased FIR filter and the error-entropy filter over a record, beside dense passes in extended precision.
#include "tests/engine/methods/replay/filter_rig.hpp"
#include "tests/engine/methods/replay/plain_filters.hpp"

namespace vigil::replay::filters_other_test {
namespace {

constexpr int kTicks = 30;

System system_of() {
  RandomMatrices random(3);
  System s;
  s.A = Eigen::Matrix3d{{0.9, 0.2, -0.1}, {0, 1.02, 0.3}, {0.2, -0.2, 0.7}};
  s.B = Eigen::MatrixXd{{1}, {0.5}, {-1}};
  s.C = Eigen::MatrixXd{{1, 0, 0.5}, {0.2, 1, 0}};
  s.P = 0.1 * random.definite(3);
  s.R = 0.1 * random.definite(2);
  s.Mw = s.P;
  s.Mv = s.R;
  return s;
}

using plain::real;

/// The least-squares fit of readings first..last (ticks, from 1).
plain::Vector fit(const System& system, const rig::Record& record, int first, int last) {
  std::vector<plain::Vector> y, u;
  for (int k = first; k <= last; ++k) {
    y.push_back(real(record.y[static_cast<std::size_t>(k - 1)]));
    u.push_back(real(record.u[static_cast<std::size_t>(k - 1)]));
  }
  return plain::fitted(plain::Model(system), y, u);
}

void expect_estimate(const Method& method, const plain::Vector& expected, double tolerance, int k) {
  const Eigen::VectorXd x = rig::estimate(method, 3);
  for (int c = 0; c < 3; ++c)
    ASSERT_NEAR(x[c], static_cast<double>(expected[c]), tolerance * std::max(1.0, x.norm())) << "tick " << k;
}

// What the iteration over the horizon computes is the fit of its readings, all weighed alike, however the input varies.
TEST(UfirFilter, IsTheFitOfItsHorizon) {
  const System system = system_of();
  const rig::Record record = rig::record_of(system, kTicks, 91);
  for (const int horizon : {3, 4, 10, 100}) {
    const auto method = rig::make("ufir_filter", rig::knowledge_of(system), {{"N", horizon}});
    FaultTable faults;
    for (int k = 1; k <= kTicks; ++k) {
      rig::tick(*method, record.y[static_cast<std::size_t>(k - 1)], record.u[static_cast<std::size_t>(k - 1)], faults,
                k);
      EXPECT_EQ(method->ready(), k >= 3);
      if (k >= 3) expect_estimate(*method, fit(system, record, std::max(1, k - horizon + 1), k), 1e-8, k);
      if (testing::Test::HasFatalFailure()) return;
    }
  }
}

// "Unbiased": without noise the state itself, from any start, under any input.
TEST(UfirFilter, IsExactWithoutNoise) {
  const System system = system_of();
  RandomMatrices random(92);
  const auto method = rig::make("ufir_filter", rig::knowledge_of(system), Json::object());
  FaultTable faults;
  Eigen::VectorXd x = 50 * random.vector(3);
  for (int k = 1; k <= 60; ++k) {
    const Eigen::VectorXd u = 10 * random.vector(1);
    x = system.A * x + system.B * u;
    rig::tick(*method, system.C * x, u, faults, k);
    if (k >= 3) {
      EXPECT_LT((rig::estimate(*method, 3) - x).norm(), 1e-9 * std::max(1.0, x.norm())) << k;
    }
  }
}

TEST(UfirFilter, PredictsThroughAGapAndFillsItsWindowAnew) {
  const System system = system_of();
  rig::Record record = rig::record_of(system, kTicks, 93);
  record.y[14][1] = std::numeric_limits<double>::quiet_NaN();  // tick 15
  const auto method = rig::make("ufir_filter", rig::knowledge_of(system), {{"N", 6}});
  FaultTable faults;
  Eigen::VectorXd before(3);
  for (int k = 1; k <= kTicks; ++k) {
    const auto i = static_cast<std::size_t>(k - 1);
    before = rig::estimate(*method, 3);
    rig::tick(*method, record.y[i], record.u[i], faults, k);
    if (k >= 15 && k <= 17) {  // two good readings determine no state of three components
      const Eigen::VectorXd predicted = system.A * before + system.B * record.u[i];
      EXPECT_LT((rig::estimate(*method, 3) - predicted).norm(), 1e-12) << k;
    } else if (k >= 18) {
      expect_estimate(*method, fit(system, record, std::max(16, k - 5), k), 1e-8, k);
    }
  }
  const auto told = vigil::rig::faults_of(faults, *method);
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].code, "no_reading");
  EXPECT_EQ(told[0].count, 1);
}

struct Kernel {
  double alpha, beta;
  const char* form;
};

plain::Gmee started(const System& system, const rig::Record& record, int end) {
  return {fit(system, record, end - 2, end), plain::first_sets(plain::Model(system)).Q};
}

TEST(Gmeekf, PassesARecordAsTheDenseFormulas) {
  const System system = system_of();
  const plain::Model model(system);
  const rig::Record record = rig::record_of(system, kTicks, 94);
  for (const Kernel& kernel :
       {Kernel{2, 2, "square"}, Kernel{2, 5, "square"}, Kernel{3, 2, "square"}, Kernel{2, 5, "diff"}}) {
    SCOPED_TRACE(std::to_string(kernel.alpha) + " " + std::to_string(kernel.beta) + " " + kernel.form);
    const auto method = rig::make("gmeekf", rig::knowledge_of(system),
                                  {{"alpha", kernel.alpha}, {"beta", kernel.beta}, {"form", kernel.form}});
    FaultTable faults;
    plain::Gmee plain;
    for (int k = 1; k <= kTicks; ++k) {
      const auto i = static_cast<std::size_t>(k - 1);
      rig::tick(*method, record.y[i], record.u[i], faults, k);
      EXPECT_EQ(method->ready(), k >= 3);
      if (k == 3) plain = started(system, record, 3);
      if (k > 3)
        plain.step(model, kernel.alpha, kernel.beta, std::string(kernel.form) == "square", real(record.u[i]),
                   real(record.y[i]));
      if (k < 3) continue;
      expect_estimate(*method, plain.x, 1e-5, k);
      const Eigen::MatrixXd P = vigil::rig::bound(*method, 0, 3);
      ASSERT_LT((P - plain::rounded(plain.P)).norm(), 1e-5 * P.norm()) << k;
    }
  }
}

TEST(Gmeekf, PredictsThroughAGap) {
  const System system = system_of();
  const plain::Model model(system);
  rig::Record record = rig::record_of(system, kTicks, 95);
  record.y[0][0] = std::numeric_limits<double>::quiet_NaN();   // the batch waits: ticks 2, 3, 4
  record.y[11][1] = std::numeric_limits<double>::quiet_NaN();  // tick 12
  const auto method = rig::make("gmeekf", rig::knowledge_of(system), Json::object());
  FaultTable faults;
  plain::Gmee plain;
  for (int k = 1; k <= kTicks; ++k) {
    const auto i = static_cast<std::size_t>(k - 1);
    rig::tick(*method, record.y[i], record.u[i], faults, k);
    EXPECT_EQ(method->ready(), k >= 4);
    if (k < 4) continue;
    if (k == 4) {
      plain = started(system, record, 4);
    } else if (k == 12) {
      plain.coast(model, real(record.u[i]));
    } else {
      plain.step(model, 2, 2, true, real(record.u[i]), real(record.y[i]));
    }
    expect_estimate(*method, plain.x, 1e-5, k);
  }
  ASSERT_EQ(vigil::rig::faults_of(faults, *method).size(), 1U);
}

}  // namespace
}  // namespace vigil::replay::filters_other_test
