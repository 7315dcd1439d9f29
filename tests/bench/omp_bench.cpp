/// Solves a second of orthogonal matching pursuit on the Gram form beside a bare fixed-size loop of it, on the same
/// windows: all twelve picks, then with the noise stop on windows that hold 0 to 12 falsified readings. Thread CPU
/// time, best of seven, interleaved. Basis pursuit on the same windows for information.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>

#include "engine/linalg/basis_pursuit.hpp"
#include "engine/linalg/omp.hpp"
#include "tests/bench/yardsticks/omp_fixed.hpp"

namespace {

using yardstick::kOmpColumns;
using yardstick::kOmpPicks;
using yardstick::kOmpRing;
using yardstick::kOmpRows;

constexpr int kSolves = 40'000;
constexpr int kRepeats = 7;
constexpr double kBar = 0.5;
constexpr double kNoiseStop = 0.10628;  // specification, section 8

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Calls a second of CPU time of one batch, window after window.
template <class Solve>
double rate(int solves, Solve&& solve) {
  const double before = cpu_seconds();
  for (int i = 0; i < solves; ++i) solve(i % kOmpRing);
  return solves / (cpu_seconds() - before);
}

/// False where the two do not answer the same.
bool compare(const char* what, const yardstick::OmpProblems& problems, double tolerance) {
  const Eigen::MatrixXd gram = problems.gram;
  const std::vector<Eigen::VectorXd> right(problems.right.begin(), problems.right.end());
  vigil::Omp omp(kOmpColumns, kOmpPicks);
  yardstick::FixedOmp loop(problems);
  const auto ours_on = [&](int k) {
    const auto window = static_cast<std::size_t>(k);
    omp.solve_gram(gram, right[window], problems.norm[window], kOmpPicks, tolerance);
    return omp.residual();
  };
  for (int k = 0; k < kOmpRing; ++k) {
    const double residual = ours_on(k), bare = loop.solve(k, tolerance);
    if (std::abs(residual - bare) > 1e-6 || static_cast<int>(omp.support().size()) != loop.picked()) return false;
  }
  double ours = 0, bare = 0;
  volatile double sink = 0;
  for (int repeat = 0; repeat < kRepeats; ++repeat) {
    ours = std::max(ours, rate(kSolves, [&](int k) { sink = ours_on(k); }));
    bare = std::max(bare, rate(kSolves, [&](int k) { sink = loop.solve(k, tolerance); }));
  }
  std::printf("omp  %s: ours %.0f solves/s  yardstick %.0f  ratio %.2f  (bar %.1f)\n", what, ours, bare, ours / bare,
              kBar);
  return true;
}

void basis_pursuit(const yardstick::OmpProblems& problems) {
  // D with D' D = the Gram matrix, a projector: its eigenvectors for the eigenvalue 1, which come last.
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(problems.gram);
  const Eigen::MatrixXd D = eigen.eigenvectors().rightCols(kOmpRows).transpose();
  std::vector<Eigen::VectorXd> right;
  for (const auto& b : problems.right) right.push_back(D * b);
  vigil::BasisPursuit solver(kOmpRows, kOmpColumns);
  int failures = 0;
  double best = 0;
  for (int repeat = 0; repeat < kRepeats; ++repeat) {
    best = std::max(
        best, rate(kOmpRing * 16, [&](int k) { failures += !solver.solve(D, right[static_cast<std::size_t>(k)]); }));
  }
  std::printf("omp  basis pursuit on the same windows: %.0f solves/s, %d failures\n", best, failures);
}

}  // namespace

int main() {
  const auto full = yardstick::omp_problems(5, [](int) { return kOmpPicks; });
  const auto filling = yardstick::omp_problems(6, [](int k) { return k % (kOmpPicks + 1); });
  if (!compare("36 columns, 12 picks", full, 0) || !compare("36 columns, noise stop", filling, kNoiseStop)) {
    std::fprintf(stderr, "ours and the yardstick do not agree: the figures would mean nothing\n");
    return 1;
  }
  basis_pursuit(full);
  return 0;
}
