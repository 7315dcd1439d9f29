#include "engine/run/stationary_start.hpp"

#include "engine/linalg/covariance.hpp"
#include "engine/methods/privacy/protection.hpp"
#include "engine/random/draws.hpp"
#include "engine/run/adversary.hpp"

namespace vigil {

using Eigen::MatrixXd;

// An error is orthogonal to its estimate, so that E[error x'] is the error's own covariance.
StationaryStart::StationaryStart(const Knowledge& knowledge, bool with_state) {
  const privacy::FusionModel model = under("/initial/estimates", [&] { return privacy::fusion_model(knowledge); });
  const auto filters = privacy::stationary_filters(model);
  if (!filters)
    throw InputError("/initial/estimates",
                     "a sensor's filter has no stationary law: the state is not detectable from it alone", "\"truth\"");
  const int n = model.states(), all = n + model.stacked();
  MatrixXd joint = MatrixXd::Zero(all, all);
  joint.bottomRightCorner(all - n, all - n) = filters->P;
  if (with_state) {
    const auto S = privacy::state_covariance(model);
    if (!S) throw InputError("/initial/x0_random", "the plant is not stable: its state has no stationary law", "false");
    joint.topLeftCorner(n, n) = *S;
    for (int i = 0; i < model.count(); ++i) {
      const MatrixXd own = filters->P.block(i * n, i * n, n, n);
      joint.block(n + i * n, 0, n, n) = own;
      joint.block(0, n + i * n, n, n) = own;
    }
  }
  Eigen::VectorXd normals(all);
  Draws(knowledge.seed, "initial.stationary").normals(0, normals);
  draw_ = symmetric_root(joint) * normals;
}

MatrixXd StationaryStart::errors(int n) const {
  const Eigen::Index count = (draw_.size() - n) / n;
  return draw_.tail(draw_.size() - n).reshaped(n, count);
}

}  // namespace vigil
