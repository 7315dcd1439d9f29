#include "engine/methods/sparse/identifiability.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "engine/methods/sparse/window.hpp"

namespace vigil::sparse {
namespace {

constexpr double kFarthest = 1e15;  ///< ticks

struct Station {
  int eigvec_support = 0, phi_support = 0;
  double coherence = 0;
};

int support(const Eigen::VectorXcd& v) {
  const Eigen::VectorXd size = v.cwiseAbs();
  return static_cast<int>((size.array() > 1e-9 * size.maxCoeff()).count());
}

/// The largest |d_i' d_j| / (||d_i|| ||d_j||) of the dictionary D = Q2', from its Gram matrix M.
double mutual_coherence(const Eigen::MatrixXd& Phi) {
  Eigen::MatrixXd Q1;
  if (!orthonormalise(Phi, Q1)) return 1;
  Eigen::MatrixXd M = Eigen::MatrixXd::Identity(Phi.rows(), Phi.rows());
  M.noalias() -= Q1 * Q1.transpose();
  double most = 0;
  for (Eigen::Index i = 0; i < M.rows(); ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      const double size = std::sqrt(std::max(M(i, i) * M(j, j), 0.0));
      if (size > 1e-12) most = std::max(most, std::abs(M(i, j)) / size);
    }
  }
  return std::min(most, 1.0);
}

/// F^ticks x, by squaring: a report may lie far out.
Eigen::VectorXd later(Eigen::MatrixXd F, Eigen::VectorXd x, std::int64_t ticks) {
  for (; ticks > 0; ticks /= 2) {
    if (ticks % 2 == 1) x = F * x;
    F = F * F;
  }
  return x;
}

/// Of one station, the window ending at the state x.
Station judge(const Sensor& sensor, const Eigen::MatrixXd& F, const Eigen::VectorXd& x, int T,
              const Eigen::MatrixXcd& eigenvectors) {
  const Eigen::Index p = sensor.size(), n = x.size();
  const Transition transition(F, T);
  Eigen::MatrixXd C(p, n), Phi(p * T, n), last(p, n);
  Eigen::VectorXd z = x;
  for (int j = T - 1; j >= 0; --j) {
    sensor.jacobian(z, C);
    if (j == T - 1) last = C;
    Phi.middleRows(j * p, p) = C * transition.power(j);
    z = Eigen::VectorXd(transition.inverse() * z);
  }
  Station station{static_cast<int>(p), static_cast<int>(p * T), mutual_coherence(Phi)};
  for (Eigen::Index v = 0; v < eigenvectors.cols(); ++v) {
    station.eigvec_support = std::min(station.eigvec_support, support(last * eigenvectors.col(v)));
    station.phi_support = std::min(station.phi_support, support(Phi * eigenvectors.col(v)));
  }
  return station;
}

}  // namespace

Json identifiability(const Knowledge& knowledge, int T, int q, double time) {
  const Plant& plant = *knowledge.plant;
  const int n = plant.states(), p = knowledge.sensors.front()->size();
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(plant.inputs());
  Eigen::MatrixXd F(n, n);
  const Eigen::VectorXd start = knowledge.estimates.col(0);
  plant.jacobian(start, none, F);
  const Eigen::VectorXd x = later(F, start, std::llround(std::min(time / knowledge.dt, kFarthest)));
  const Eigen::MatrixXcd eigenvectors = Eigen::EigenSolver<Eigen::MatrixXd>(F).eigenvectors();
  Station all{p, p * T, 0};
  Json stations = Json::array();
  for (std::size_t i = 0; i < knowledge.sensors.size(); ++i) {
    const Station one = judge(*knowledge.sensors[i], F, x, T, eigenvectors);
    all.eigvec_support = std::min(all.eigvec_support, one.eigvec_support);
    all.phi_support = std::min(all.phi_support, one.phi_support);
    all.coherence = std::max(all.coherence, one.coherence);
    stations.push_back({{"node", knowledge.nodes[i]},
                        {"eigvec_support", one.eigvec_support},
                        {"phi_support", one.phi_support},
                        {"coherence", one.coherence}});
  }
  return {{"time", time},
          {"q", q},
          {"dimension_ok", 2 * q * T <= p * T - n},
          {"dimension", {2 * q * T, p * T - n}},
          {"eigvec_support", all.eigvec_support},
          {"phi_support", all.phi_support},
          {"q_max", std::max(0, (all.eigvec_support - 1) / 2)},
          {"coherence", all.coherence},
          {"stations", std::move(stations)}};
}

}  // namespace vigil::sparse
