/// What happens where (28) or (29) fails: section 6.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "engine/methods/consensus/kernel.hpp"
#include "engine/random/draws.hpp"

namespace vigil::guards_test {
namespace {

using consensus::Constants;
using consensus::Guard;
using Node = consensus::Node<3, 2>;

Eigen::Matrix3d with_eigenvalues(const Eigen::Vector3d& values, std::int64_t tick) {
  Eigen::VectorXd draw(9);
  Draws(2, "basis").normals(tick, draw);
  const Eigen::Matrix3d basis = Eigen::HouseholderQR<Eigen::Matrix3d>(draw.reshaped(3, 3)).householderQ();
  return basis * values.asDiagonal() * basis.transpose();
}

Node node_of(const Eigen::Matrix3d& Phi, double q = 1) {
  Node node;
  node.Phi = Phi;
  node.UU = 1e-4 * Eigen::Matrix3d::Identity();
  node.Q = q * Eigen::Matrix3d::Identity();
  node.R.setIdentity();
  node.VV = 0.01 * Eigen::Matrix2d::Identity();
  EXPECT_TRUE(consensus::decompose(node));
  return node;
}

/// The symmetric function of a matrix, eigenvalue by eigenvalue.
template <class Function>
Eigen::Matrix3d mapped(const Eigen::Matrix3d& a, const Function& f) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(a);
  return eigen.eigenvectors() * eigen.eigenvalues().unaryExpr(f).asDiagonal() * eigen.eigenvectors().transpose();
}

Eigen::Vector3d eigenvalues(const Eigen::Matrix3d& a) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(a).eigenvalues();
}

const Eigen::Matrix3d kTurn = (Eigen::Matrix3d() << 1, 0, -0.02, 0, 1, 0.13, 0, 0, 1).finished();

TEST(Clip, KeepsEverythingInsideItsLimits) {
  const Constants c;
  for (int trial = 0; trial < 50; ++trial) {
    const bool positive = trial % 2 == 0;
    const Eigen::Matrix3d Phi = with_eigenvalues({positive ? 0.01 : -0.01, 3, 5.0 + 12 * trial}, trial);
    Node node = node_of(Phi);
    ASSERT_TRUE(consensus::predict_bound(node, kTurn, c, 3));
    EXPECT_EQ(node.feasible28, positive && 5.0 + 12 * trial < c.limit28());
    EXPECT_FALSE(node.feasible29);
    EXPECT_TRUE(node.Phi.isApprox(Phi)) << "the published Phi stays raw";
    // Step 2 and 3 with the clipped copy, then step 4.
    const double top = 0.9 * c.limit28(), a = 1.3 * 0.1;
    const Eigen::Matrix3d inner = mapped(Phi, [&](double v) {
      const double clipped = std::clamp(v, 1e-12, top);
      return clipped / (1 - a * clipped);
    });
    const Eigen::Matrix3d raw = kTurn * inner * kTurn.transpose() + node.UU / (0.3 * 0.1) + node.Q;
    EXPECT_NEAR(node.lambda_predicted, eigenvalues(raw)[2], 1e-10 * node.lambda_predicted);
    EXPECT_TRUE(node.Pp.isApprox(mapped(raw, [](double v) { return std::min(v, 9.0); }), 1e-10));
    EXPECT_LE(eigenvalues(node.Pp)[2], 9 * (1 + 1e-12));
    EXPECT_LE(eigenvalues(node.M1)[2], 90 * (1 + 1e-9));
    EXPECT_TRUE(node.C.isApprox(0.01 * node.Pp));
    EXPECT_NEAR(node.c_norm, eigenvalues(node.C)[2], 1e-12);
  }
}

TEST(Clip, LetsThroughWhatFits) {
  for (const Guard guard : {Guard::clip, Guard::strict, Guard::none, Guard::adapt}) {
    Constants c;
    c.guard = guard;
    Node node = node_of(with_eigenvalues({0.2, 0.5, 1}, 4), 0.5);
    ASSERT_TRUE(consensus::predict_bound(node, kTurn, c, 2));
    const Eigen::Matrix3d inner = (node.Phi.inverse() - 0.13 * Eigen::Matrix3d::Identity()).inverse();
    const Eigen::Matrix3d raw = kTurn * inner * kTurn.transpose() + node.UU / 0.03 + node.Q;
    EXPECT_TRUE(node.feasible28 && node.feasible29);
    EXPECT_TRUE(node.Pp.isApprox(raw, 1e-12));
    EXPECT_TRUE(node.M1.isApprox((raw.inverse() - 0.1 * Eigen::Matrix3d::Identity()).inverse(), 1e-10));
  }
}

TEST(Adapt, FollowsItsFormulas) {
  Constants c;
  c.guard = Guard::adapt;
  c.tau = 0.4;
  for (int trial = 0; trial < 20; ++trial) {
    const double largest = 2.0 + 50 * trial;
    const Eigen::Matrix3d Phi = with_eigenvalues({0.3, 1, largest}, trial);
    Node node = node_of(Phi);
    ASSERT_TRUE(consensus::predict_bound(node, kTurn, c, 3));
    const double sigma = std::min(0.1, 0.9 / (1.3 * largest));
    const Eigen::Matrix3d inner = (Phi.inverse() - 1.3 * sigma * Eigen::Matrix3d::Identity()).inverse();
    const Eigen::Matrix3d raw = kTurn * inner * kTurn.transpose() + node.UU / (0.3 * sigma) + node.Q;
    EXPECT_TRUE(node.Pp.isApprox(raw, 1e-9)) << trial;
    EXPECT_NEAR(node.beta, std::min(0.1, 0.9 / eigenvalues(raw)[2]), 1e-9);
    EXPECT_TRUE(node.M1.isApprox((raw.inverse() - node.beta * Eigen::Matrix3d::Identity()).inverse(), 1e-7));
    EXPECT_TRUE(node.C.isApprox(mapped(0.4 * raw, [](double v) { return std::min(v, 0.25); }), 1e-9))
        << "eigenvalues of C at most 1/(1+d)";
  }
}

TEST(None, DoesAsPrinted) {
  Constants c;
  c.guard = Guard::none;
  Node node = node_of(with_eigenvalues({0.3, 1, 20}, 7));
  ASSERT_TRUE(consensus::predict_bound(node, kTurn, c, 3));
  const Eigen::Matrix3d inner = (node.Phi.inverse() - 0.13 * Eigen::Matrix3d::Identity()).inverse();
  EXPECT_TRUE(node.Pp.isApprox(kTurn * inner * kTurn.transpose() + node.UU / 0.03 + node.Q, 1e-10));
  EXPECT_LT(eigenvalues(node.Pp)[0], 0) << "indefinite, as the specification says";
  EXPECT_FALSE(node.feasible28);
  EXPECT_FALSE(node.feasible29);
}

TEST(Kernel, SaysSoWhereNothingIsFinite) {
  for (const Guard guard : {Guard::clip, Guard::strict, Guard::none, Guard::adapt}) {
    Constants c;
    c.guard = guard;
    Node node = node_of(Eigen::Matrix3d::Identity());
    EXPECT_FALSE(consensus::predict_bound(node, Eigen::Matrix3d::Constant(std::nan("")), c, 2));
    node.Phi(1, 1) = std::numeric_limits<double>::infinity();
    EXPECT_FALSE(consensus::decompose(node));
  }
}

}  // namespace
}  // namespace vigil::guards_test
