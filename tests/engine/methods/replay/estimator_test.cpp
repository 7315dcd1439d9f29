/// The mixed estimator over whole runs of the tank: its bounds hold, and its errors are those the specification
/// measured. The error depends on no input, so none is applied.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "engine/methods/replay/batch.hpp"
#include "engine/methods/replay/gmee_update.hpp"
#include "engine/methods/replay/mixed_update.hpp"
#include "tests/engine/linalg/random_matrices.hpp"
#include "tests/engine/methods/replay/tank.hpp"

namespace vigil::replay::estimator_test {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

enum class Bounded { uniform, surface, sine };

/// States and readings of samples 0..300 of one run.
struct Record {
  std::vector<VectorXd> x, y;
  Record(const tank::Scenario& scenario, std::int64_t number, Bounded kind = Bounded::uniform) {
    const Draws draws(11, "record");
    std::uint32_t next = 0;
    const double phase = 6.283185307179586 * draws.uniform(number, 100000);
    const auto gmix = [&] {
      const double size = draws.uniform(number, next++) < 0.1 ? 5 : 1;
      return size / std::sqrt(3.4) * draws.normal(number, next++);
    };
    const auto noise = [&](int k) {
      Vector2d direction(draws.normal(number, next), draws.normal(number, next + 1));
      direction.normalize();
      const double radius = kind == Bounded::uniform ? std::sqrt(draws.uniform(number, next + 2)) : 1;
      next += 3;
      if (kind == Bounded::sine) direction = {std::cos(0.7 * k + phase), std::sin(0.7 * k + phase)};
      const double first = gmix(), second = gmix();
      return VectorXd(std::sqrt(scenario.size) * radius * direction +
                      std::sqrt(scenario.variance) * Vector2d(first, second));
    };
    VectorXd state = VectorXd::Ones(2);
    for (int k = 0; k <= 300; ++k) {
      if (k > 0) state = tank::A * state + noise(k);
      x.push_back(state);
      y.push_back(tank::C * state + noise(k));
    }
  }
};

/// Bounds and gains of every sample from 2 on: the batch's, then the filter's.
struct Schedule {
  std::vector<Bounds> bounds;
  std::vector<MatrixXd> gains;
  Schedule(const tank::Scenario& scenario, double zeta_max) : bounds(2), gains(3) {
    const MatrixXd P = scenario.noise(), Mw = scenario.bounded();
    const MixedUpdate update(tank::C, P, Mw, scenario.mu, zeta_max);
    bounds.push_back(Batch::make(tank::A, tank::B, tank::C)->error(P, P, Mw, Mw));
    for (int k = 3; k <= 300; ++k) {
      Bounds now = bounds.back();
      time_update(tank::A, P, Mw, now);
      const auto gain = update.update(now.Q, now.M);
      gains.push_back(gain->K);
      bounds.push_back({gain->Q, gain->M});
    }
  }
};

VectorXd started(const Record& record, int k) {
  MatrixXd Y(2, 2);
  Y << record.y[static_cast<std::size_t>(k - 1)], record.y[static_cast<std::size_t>(k)];
  return Batch::make(tank::A, tank::B, tank::C)->estimate(Y, MatrixXd::Zero(1, 2));
}

/// The errors of samples 2..300.
std::vector<VectorXd> mixed_errors(const Record& record, const Schedule& schedule) {
  VectorXd x = started(record, 2);
  std::vector<VectorXd> errors{record.x[2] - x};
  for (std::size_t k = 3; k <= 300; ++k) {
    const VectorXd xp = tank::A * x;
    x = xp + schedule.gains[k] * (record.y[k] - tank::C * xp);
    errors.push_back(record.x[k] - x);
  }
  return errors;
}

std::vector<VectorXd> gmee_errors(const Record& record, const GmeeSettings& settings) {
  const MatrixXd P = tank::kScenarios[0].noise(), none = MatrixXd::Zero(2, 2);
  const GmeeUpdate update(tank::C, P, settings);
  VectorXd x = started(record, 2);
  MatrixXd covariance = Batch::make(tank::A, tank::B, tank::C)->error(P, P, none, none).Q;
  std::vector<VectorXd> errors{record.x[2] - x};
  for (std::size_t k = 3; k <= 300; ++k) {
    const auto step = update.update(tank::A * x, tank::A * covariance * tank::A.transpose() + P, record.y[k]);
    x = step->x;
    covariance = step->P;
    errors.push_back(record.x[k] - x);
  }
  return errors;
}

/// Section 4.2 with a horizon of ten, B u = 0.
std::vector<VectorXd> unbiased_errors(const Record& record) {
  const auto batch = Batch::make(tank::A, tank::B, tank::C);
  std::vector<VectorXd> errors;
  for (int k = 2; k <= 300; ++k) {
    const int first = std::max(1, k - 9);
    VectorXd x = started(record, first + 1);
    MatrixXd G = batch->G();
    for (int l = first + 2; l <= k; ++l) {
      const VectorXd xp = tank::A * x;
      G = (tank::C.transpose() * tank::C + (tank::A * G * tank::A.transpose()).inverse()).inverse();
      x = xp + G * tank::C.transpose() * (record.y[static_cast<std::size_t>(l)] - tank::C * xp);
    }
    errors.push_back(record.x[static_cast<std::size_t>(k)] - x);
  }
  return errors;
}

/// Over samples 20..300 and both states: root mean square of all runs, and the mean over runs of the largest error.
struct Score {
  double squares = 0, peaks = 0;
  int entries = 0, runs = 0;
  void add(const std::vector<VectorXd>& errors) {
    double peak = 0;
    for (std::size_t i = 18; i < errors.size(); ++i) {
      squares += errors[i].squaredNorm();
      entries += 2;
      peak = std::max(peak, errors[i].cwiseAbs().maxCoeff());
    }
    peaks += peak;
    ++runs;
  }
  double rmse() const { return std::sqrt(squares / entries); }
  double peak() const { return peaks / runs; }
};

TEST(Estimator, BoundedErrorsNeverLeaveTheirEllipsoid) {
  const auto& scenario = tank::kScenarios[1];
  for (const double zeta_max : {tank::kAsPrinted, 1.0}) {
    const Schedule schedule(scenario, zeta_max);
    double furthest = 0;
    for (const Bounded kind : {Bounded::uniform, Bounded::surface, Bounded::sine}) {
      for (int run = 0; run < 200; ++run) {
        const auto errors = mixed_errors(Record(scenario, run, kind), schedule);
        for (std::size_t i = 0; i < errors.size(); ++i) {
          const MatrixXd M = schedule.bounds[i + 2].M;
          furthest = std::max(furthest, errors[i].dot(M.inverse() * errors[i]));
        }
      }
    }
    EXPECT_LE(furthest, 1 + 1e-12);
    EXPECT_GT(furthest, 0.7);
  }
}

TEST(Estimator, ErrorsHaveTheCovarianceItSays) {
  const auto& scenario = tank::kScenarios[0];
  const Schedule schedule(scenario, tank::kAsPrinted);
  Vector2d ratio = Vector2d::Zero();
  int count = 0;
  for (int run = 0; run < 400; ++run) {
    const auto errors = mixed_errors(Record(scenario, run), schedule);
    for (std::size_t i = 0; i < errors.size(); ++i, ++count) {
      ratio += errors[i].cwiseAbs2().cwiseQuotient(VectorXd(schedule.bounds[i + 2].Q.diagonal()));
    }
  }
  ratio /= count;
  EXPECT_NEAR(ratio[0], 1, 0.02);
  EXPECT_NEAR(ratio[1], 1, 0.02);
}

// Section 4.5's table, to about four standard errors of 120 runs.
TEST(Estimator, ErrorsAreAsLargeAsMeasured) {
  const struct {
    double zeta_max, rmse, peak;
  } table[3][2] = {{{tank::kAsPrinted, 0.370, 2.03}, {1, 0.370, 2.03}},
                   {{tank::kAsPrinted, 0.390, 0.853}, {1, 0.328, 0.808}},
                   {{tank::kAsPrinted, 0.631, 3.53}, {1, 0.523, 2.82}}};
  const double unbiased[] = {0.78, 0.61, 0.99};
  for (std::size_t i = 0; i < 3; ++i) {
    SCOPED_TRACE(i + 1);
    const auto& scenario = tank::kScenarios[i];
    for (const auto& row : table[i]) {
      const Schedule schedule(scenario, row.zeta_max);
      Score score;
      for (int run = 0; run < 120; ++run) score.add(mixed_errors(Record(scenario, run), schedule));
      EXPECT_NEAR(score.rmse(), row.rmse, 0.02 * row.rmse);
      EXPECT_NEAR(score.peak(), row.peak, 0.06 * row.peak);
    }
    Score score;
    for (int run = 0; run < 60; ++run) score.add(unbiased_errors(Record(scenario, run)));
    EXPECT_NEAR(score.rmse(), unbiased[i], 0.03 * unbiased[i]);
  }
}

TEST(Estimator, OnTheSurfaceTheErrorIsTheSensorsOwn) {
  const Schedule schedule(tank::kScenarios[1], tank::kAsPrinted);
  Score score;
  for (int run = 0; run < 60; ++run)
    score.add(mixed_errors(Record(tank::kScenarios[1], run, Bounded::surface), schedule));
  EXPECT_NEAR(score.rmse(), 0.551, 0.01);
  EXPECT_NEAR(score.peak(), 0.870, 0.01);
}

// Section 8.1: by how much the proposed filter's peaks are below those of GMEEKF depends on the kernel.
TEST(Estimator, PeaksBesideTheEntropyFilterDependOnItsTuning) {
  const struct {
    GmeeSettings settings;
    double reduction;
  } table[] = {{{2, 2, GmeeForm::square}, 0.18},
               {{2, 5, GmeeForm::square}, 0.13},
               {{3, 2, GmeeForm::square}, 0.44},
               {{2, 5, GmeeForm::diff}, 0.64}};
  const Schedule schedule(tank::kScenarios[0], tank::kAsPrinted);
  for (const auto& row : table) {
    Score proposed, entropy;
    for (int run = 0; run < 60; ++run) {
      const Record record(tank::kScenarios[0], run);
      proposed.add(mixed_errors(record, schedule));
      entropy.add(gmee_errors(record, row.settings));
    }
    EXPECT_NEAR(1 - proposed.peak() / entropy.peak(), row.reduction, 0.05);
  }
}

}  // namespace
}  // namespace vigil::replay::estimator_test
