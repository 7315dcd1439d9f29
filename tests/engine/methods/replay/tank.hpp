/// The two tanks of seed 003 and its three scenarios, as the specification (replay) prints them.
#pragma once

#include <Eigen/Core>
#include <limits>

namespace vigil::replay::tank {

inline const Eigen::MatrixXd A = Eigen::MatrixXd({{1, -0.1}, {0.1, 0.9}});
inline const Eigen::MatrixXd B = Eigen::MatrixXd({{0.7}, {0.3}});
inline const Eigen::MatrixXd C = Eigen::MatrixXd({{1, 0.2}, {-0.3, 0.789}});

struct Scenario {
  double variance, size, mu;  ///< P = R = variance I, Mw = Mv = size I
  double iota;
  int tau;
  double eta = 2;
  Eigen::MatrixXd noise() const { return variance * Eigen::MatrixXd::Identity(2, 2); }
  Eigen::MatrixXd bounded() const { return size * Eigen::MatrixXd::Identity(2, 2); }
};

inline constexpr Scenario kScenarios[3] = {
    {0.2, 0, 1, 0.3, 20},
    {0, 0.5, 0, 0.1, 15},
    {0.2, 0.5, 0.5, 0.3, 25},
};
inline constexpr double kAsPrinted = std::numeric_limits<double>::infinity();

}  // namespace vigil::replay::tank
