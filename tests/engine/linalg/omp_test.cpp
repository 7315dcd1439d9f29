#include "engine/linalg/omp.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/engine/allocations.hpp"
#include "tests/engine/linalg/dictionaries.hpp"

namespace vigil::omp_test {
namespace {

using dictionaries::Trial;
using Support = std::vector<int>;

Support support_of(const Omp& omp) { return {omp.support().begin(), omp.support().end()}; }

struct Answer {
  Eigen::VectorXd entries;
  Support support;
  double residual = 0;
};

/// The text of the specification, section 8, word for word: the whole least-squares problem again after each pick.
Answer textbook(const Eigen::MatrixXd& D, const Eigen::VectorXd& y, int picks, double tolerance) {
  Answer answer{Eigen::VectorXd::Zero(D.cols()), {}, y.norm()};
  Eigen::VectorXd residual = y, coefficients;
  while (static_cast<int>(answer.support.size()) < picks && answer.residual > tolerance) {
    int best = -1;
    double most = -1;
    for (int j = 0; j < D.cols(); ++j) {
      if (std::find(answer.support.begin(), answer.support.end(), j) != answer.support.end()) continue;
      const double gain = std::abs(D.col(j).dot(residual)) / D.col(j).norm();
      if (gain > most) {
        most = gain;
        best = j;
      }
    }
    answer.support.push_back(best);
    const Eigen::MatrixXd chosen = D(Eigen::all, answer.support);
    coefficients = chosen.colPivHouseholderQr().solve(y);
    residual = y - chosen * coefficients;
    answer.residual = residual.norm();
  }
  for (std::size_t i = 0; i < answer.support.size(); ++i) {
    answer.entries[answer.support[i]] = coefficients[static_cast<Eigen::Index>(i)];
  }
  return answer;
}

/// Both forms beside the textbook.
void expect_agreement(const Eigen::MatrixXd& D, const Eigen::VectorXd& y, int picks, double tolerance) {
  const Answer expected = textbook(D, y, picks, tolerance);
  const double scale = 1 + expected.entries.cwiseAbs().maxCoeff();
  Omp explicit_form(static_cast<int>(D.cols()), picks), gram_form(static_cast<int>(D.cols()), picks);
  ASSERT_TRUE(explicit_form.solve(D, y, picks, tolerance));
  ASSERT_TRUE(gram_form.solve_gram(D.transpose() * D, D.transpose() * y, y.norm(), picks, tolerance));
  for (const Omp* omp : {&explicit_form, &gram_form}) {
    EXPECT_EQ(support_of(*omp), expected.support);
    EXPECT_LE((omp->entries() - expected.entries).cwiseAbs().maxCoeff(), 1e-10 * scale);
    EXPECT_NEAR(omp->residual(), expected.residual, 1e-7 * y.norm());
    EXPECT_EQ((omp->entries().array() != 0).count(), static_cast<Eigen::Index>(expected.support.size()));
  }
  EXPECT_NEAR(explicit_form.residual(), expected.residual, 1e-12 * y.norm());
}

TEST(Omp, AgreesWithTheTextbookInBothForms) {
  for (int number = 0; number < 300; ++number) {
    SCOPED_TRACE(number);
    Trial trial(number);
    const Eigen::MatrixXd D = number % 3 == 0   ? trial.orthonormal(36, 6)
                              : number % 3 == 1 ? trial.gaussian(12, 18)
                                                : trial.gaussian(30, 24);
    Eigen::VectorXd y = D * trial.sparse(static_cast<int>(D.cols()), 1 + trial.below(10), 0.3, 10);
    for (double& entry : y) entry += 0.01 * trial.normal();
    expect_agreement(D, y, 10, 0);
    expect_agreement(D, y, 10, 0.1);
  }
}

// Q2' W: the dictionary where the noise is coloured. Its Gram matrix is no projector and its columns differ in length.
TEST(Omp, AgreesWithTheTextbookOnUnequalColumns) {
  for (int number = 0; number < 100; ++number) {
    SCOPED_TRACE(number);
    Trial trial(1000 + number);
    Eigen::VectorXd weights(36);
    for (double& weight : weights) weight = std::pow(10, 4 * trial.uniform() - 2);
    const Eigen::MatrixXd D = trial.orthonormal(36, 6) * weights.asDiagonal();
    expect_agreement(D, trial.gaussian(30, 1), 12, 0.5);
  }
}

// Tropp (2004): with coherence below 1/(2k - 1) every signal of k entries comes back, in any k picks. Unit vectors
// beside a Hadamard basis have coherence 1/sqrt(rows).
TEST(Omp, RecoversExactlyWhereTheCoherenceAllows) {
  for (const auto& [power, most] : {std::pair{4, 2}, {6, 4}, {8, 8}}) {
    const Eigen::MatrixXd H = dictionaries::hadamard(power);
    Eigen::MatrixXd D(H.rows(), 2 * H.rows());
    D << Eigen::MatrixXd::Identity(H.rows(), H.rows()), H;
    const int columns = static_cast<int>(D.cols());
    ASSERT_LT(dictionaries::coherence(D), 1.0 / (2 * most - 1));
    const Eigen::MatrixXd gram = D.transpose() * D;
    Omp explicit_form(columns, 2 * most), gram_form(columns, 2 * most);
    for (int number = 0; number < 100; ++number) {
      Trial trial(10'000 * power + number);
      const int count = 1 + number % most;
      const Eigen::VectorXd truth = trial.sparse(columns, count, 0.1, 10);
      const Eigen::VectorXd y = D * truth;
      ASSERT_TRUE(explicit_form.solve(D, y, 2 * most, 1e-6 * y.norm()));
      ASSERT_TRUE(gram_form.solve_gram(gram, D.transpose() * y, y.norm(), 2 * most, 1e-6 * y.norm()));
      for (const Omp* omp : {&explicit_form, &gram_form}) {
        EXPECT_EQ(omp->support().size(), static_cast<std::size_t>(count));
        EXPECT_LE((omp->entries() - truth).cwiseAbs().maxCoeff(), 1e-12);
      }
    }
  }
}

TEST(Omp, LeavesAResidualThatIsOrthogonalToTheSupportAndNeverGrows) {
  for (int number = 0; number < 50; ++number) {
    Trial trial(2000 + number);
    const Eigen::MatrixXd D = trial.gaussian(30, 36);
    const Eigen::VectorXd y = trial.gaussian(30, 1);
    Omp omp(36, 20);
    Support before;
    double residual = y.norm();
    for (int picks = 1; picks <= 20; ++picks) {
      ASSERT_TRUE(omp.solve_gram(D.transpose() * D, D.transpose() * y, y.norm(), picks, 0));
      const Support now = support_of(omp);
      ASSERT_EQ(now.size(), static_cast<std::size_t>(picks));
      EXPECT_TRUE(std::equal(before.begin(), before.end(), now.begin())) << "more picks only add";
      EXPECT_LT(omp.residual(), residual);
      const Eigen::VectorXd left = y - D * omp.entries();
      EXPECT_NEAR(left.norm(), omp.residual(), 1e-7 * y.norm());
      EXPECT_LE((D(Eigen::all, now).transpose() * left).cwiseAbs().maxCoeff(), 1e-11 * y.norm());
      before = now;
      residual = omp.residual();
    }
  }
}

TEST(Omp, StopsAsSoonAsTheToleranceIsMet) {
  Trial trial(5);
  const Eigen::MatrixXd D = trial.gaussian(30, 36);
  const Eigen::VectorXd y = trial.gaussian(30, 1);
  Omp omp(36, 12), one_less(36, 12);
  for (const double tolerance : {4.0, 3.0, 2.0, 1.5}) {
    ASSERT_TRUE(omp.solve(D, y, 12, tolerance));
    const auto picks = static_cast<int>(omp.support().size());
    ASSERT_GT(picks, 0);
    EXPECT_TRUE(picks == 12 || omp.residual() <= tolerance);
    ASSERT_TRUE(one_less.solve(D, y, picks - 1, tolerance));
    EXPECT_GT(one_less.residual(), tolerance);
  }
  ASSERT_TRUE(omp.solve(D, y, 12, y.norm()));
  EXPECT_TRUE(omp.support().empty()) << "the tolerance may be met from the first";
}

TEST(Omp, TakesTheLowestIndexOnTies) {
  Omp omp(4, 4);
  ASSERT_TRUE(omp.solve_gram(Eigen::Matrix4d::Identity(), Eigen::Vector4d(1, -2, 2, -2), std::sqrt(13.0), 3, 0));
  EXPECT_EQ(support_of(omp), (Support{1, 2, 3}));
  ASSERT_TRUE(omp.solve(Eigen::Matrix4d::Identity(), Eigen::Vector4d(-3, 3, 3, 3), 3, 0));
  EXPECT_EQ(support_of(omp), (Support{0, 1, 2}));
  EXPECT_EQ(omp.entries(), Eigen::Vector4d(-3, 3, 3, 0));
}

TEST(Omp, WeighsAColumnByItsLength) {
  Eigen::Matrix2d D;
  D << 10, 0.1, 0, 0.1;
  Omp omp(2, 1);
  ASSERT_TRUE(omp.solve(D, Eigen::Vector2d(1, 1), 1, 0));  // along the short column
  EXPECT_EQ(support_of(omp), (Support{1}));
  EXPECT_NEAR(omp.entries()[1], 10, 1e-14);
  EXPECT_EQ(omp.entries()[0], 0);
}

#ifdef VIGIL_COUNTS_MALLOC

TEST(Omp, AllocatesNothing) {
  Trial trial(11);
  const Eigen::MatrixXd D = trial.orthonormal(36, 6), gram = D.transpose() * D;
  const Eigen::VectorXd y = trial.gaussian(30, 1), b = D.transpose() * y;
  Omp omp(36, 12);
  EXPECT_EQ(allocations_in([&] { omp.solve_gram(gram, b, y.norm(), 12, 0); }), 0);
  EXPECT_EQ(omp.support().size(), 12U);
  Omp copy(omp);
  EXPECT_EQ(allocations_in([&] { copy.solve_gram(gram, b, y.norm(), 12, 0); }), 0);
  omp.solve(D, y, 12, 0);
  EXPECT_EQ(allocations_in([&] { omp.solve(D, y, 12, 0); }), 0);
}

#endif

}  // namespace
}  // namespace vigil::omp_test
