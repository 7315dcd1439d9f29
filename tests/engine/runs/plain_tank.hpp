/// The two tanks under replay once more: plainly, in one loop of dense matrices, from the specification (replay),
/// sections 2 to 6, with the draws of a run and nothing else of it.
#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "engine/world/noise.hpp"
#include "tests/engine/methods/replay/tank.hpp"

namespace vigil::test::plain {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

inline constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

/// A row of the table in section 7.
struct Profile {
  const char* id;
  bool monitor = false, innovation = false;
  bool capped = false;  ///< zeta_max 1, else infinity
  bool frozen = false;
  char watermark = '-';  ///< 's'ensor, 'c'ontrol
  double amplitude = 0;
  bool patient = false;    ///< tau 40, eta 3 instead of the scenario's
  const char* fixed = "";  ///< "norm", "square"
};

const std::vector<Profile>& profiles();

/// What leaves one tick.
struct Row {
  Vector truth, input, arrived, sent, estimate, residual;
  Matrix covariance, shape;
  double statistic = kMissing, threshold = kMissing;
  bool alarm = false;
};

/// Section 5, from a list of all statistics so far.
class Detector {
 public:
  Detector(const Profile& profile, const replay::tank::Scenario& scenario)
      : profile_(profile),
        tau_(profile.patient ? 40 : scenario.tau),
        eta_(profile.patient ? 3 : scenario.eta),
        iota_(scenario.iota) {}

  void judge(int k, const Vector& residual, Row& row);

 private:
  void follow();

  const Profile& profile_;
  int tau_;
  double eta_, iota_;
  std::vector<double> energies_, window_;
  double threshold_ = kMissing, largest_ = 0;
  bool flagged_ = false;
};

/// The feedback gain: the Riccati equation iterated until it stands still.
Matrix feedback();

Matrix least_trace(const std::vector<Matrix>& operands);

/// Sections 4.3 to 4.5 with the gains that are optimal in the three scenarios: Kalman's for mu = 1, zeta = 1 where zeta
/// is capped, C^-1 elsewhere.
class Estimator {
 public:
  Estimator(const Profile& profile, const replay::tank::Scenario& scenario)
      : capped_(profile.capped), scenario_(scenario), P_(scenario.noise()), M0_(scenario.bounded()) {}

  bool ready() const;
  Vector x, predicted;
  Matrix Q, M;

  void take(const Vector& u, const Vector& y);

 private:
  /// The state that fits the first two readings best: y_1 = C A^-1 (x_2 - B u_1 - w - d) + v + f, y_2 = C x_2 + v + f.
  void begin(const Vector& u, const Vector& y);
  void update(const Matrix& Qp, const Matrix& Mp);

  bool capped_;
  replay::tank::Scenario scenario_;
  Matrix P_, M0_, K_;
  Vector first_;
  int k_ = 0;
};

struct Attack {
  int start = 101, end = 180;
  bool active(int k) const { return k >= start && k <= end; }
  int source(int k) const { return 50 + (k - start) % 51; }
};

/// Ticks 0 to `steps` under gmix and uniform noise.
std::vector<Row> simulate(const Profile& profile, const replay::tank::Scenario& scenario, std::uint64_t seed,
                          const Attack& attack, int steps = 300);

}  // namespace vigil::test::plain
