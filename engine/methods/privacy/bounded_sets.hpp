/// Whether the legitimate user stays bounded where the same components are contaminated at all times: Theorem 2.1
/// asserts it of every set, which is false. Specification (privacy), section 2.2.
#pragma once

#include <memory>
#include <vector>

#include "engine/methods/privacy/contamination.hpp"

namespace vigil::privacy {

/// The local filters' covariances of 400 steps, against which sets are tried. Immutable.
class BoundedCheck {
 public:
  explicit BoundedCheck(FusionModel model);
  const FusionModel& model() const { return model_; }
  /// The trace after 400 steps is at most 1.02 of the one after 200. False where the filters cannot start.
  bool bounded(const ComponentSet& set) const;

 private:
  FusionModel model_;
  std::vector<LocalStep> steps_;
  Eigen::MatrixXd start_;
  std::vector<Eigen::MatrixXd> P_;  ///< after steps 1, 2, ..; the last stands for all that follow
  std::vector<std::vector<LocalGains>> gains_;
};

/// The check of a model and its answers are remembered until another model is asked for, since the runs of a campaign
/// ask the same.
std::shared_ptr<const BoundedCheck> bounded_check(const FusionModel& model);
bool bounded(const std::shared_ptr<const BoundedCheck>& check, const ComponentSet& set);

/// Those of the sets that pass.
std::vector<ComponentSet> bounded_sets(const FusionModel& model, const std::vector<ComponentSet>& sets);

}  // namespace vigil::privacy
