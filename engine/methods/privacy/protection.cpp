#include "engine/methods/privacy/protection.hpp"

#include "engine/core/input_error.hpp"
#include "engine/methods/privacy/start.hpp"

namespace vigil::privacy {

void Protection::decode(const PublicTick& /*tick*/, const Eigen::MatrixXd& received, std::span<const char> lost,
                        Decoded& decoded) {
  const auto n = received.rows();
  decoded.fused = false;
  decoded.estimates = received;
  decoded.h.resize(received.size());
  for (Eigen::Index i = 0; i < received.cols(); ++i)
    decoded.h.segment(i * n, n).setConstant(lost[static_cast<std::size_t>(i)] ? 0 : 1);
}

FusionModel fusion_model(const Knowledge& knowledge) {
  const int n = knowledge.plant->states();
  const Eigen::VectorXd origin = Eigen::VectorXd::Zero(n);
  FusionModel model{.A = Eigen::MatrixXd(n, n),
                    .B = Eigen::MatrixXd::Identity(n, n),
                    .Q = knowledge.Q,
                    .sensors = {},
                    .x0 = prior_mean(knowledge),
                    .P0 = knowledge.stationary ? Eigen::MatrixXd() : knowledge.P0};
  bool linear = knowledge.plant->linear();
  for (const auto& sensor : knowledge.sensors) linear = linear && sensor->linear();
  if (!linear) throw InputError("", "this needs a linear plant and linear sensors");
  knowledge.plant->jacobian(origin, Eigen::VectorXd::Zero(knowledge.plant->inputs()), model.A);
  for (const auto& sensor : knowledge.sensors) {
    Eigen::MatrixXd C(sensor->size(), n);
    sensor->jacobian(origin, C);
    model.sensors.push_back({.C = C, .R = sensor->noise()});
  }
  return model;
}

}  // namespace vigil::privacy
