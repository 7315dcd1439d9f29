#include "engine/methods/privacy/eavesdroppers.hpp"

#include "engine/linalg/small.hpp"
#include "engine/methods/privacy/start.hpp"

namespace vigil::privacy {
namespace {

class FusingEavesdropper final : public Eavesdropper {
 public:
  explicit FusingEavesdropper(const Knowledge& knowledge)
      : plant_(knowledge.plant),
        no_input_(Eigen::VectorXd::Zero(plant_->inputs())),
        heard_(prior_mean(knowledge).replicate(1, static_cast<Eigen::Index>(knowledge.sensors.size()))),
        estimate_(prior_mean(knowledge)) {}

  std::unique_ptr<Eavesdropper> clone() const override { return std::make_unique<FusingEavesdropper>(*this); }

  void listen(const PublicTick& tick, const Eigen::MatrixXd& messages, std::span<const char> heard) override {
    for (Eigen::Index i = 0; i < heard_.cols(); ++i) {
      if (heard[static_cast<std::size_t>(i)])
        heard_.col(i) = messages.col(i);
      else if (tick.k > 0)
        predict(i, tick.input.size() > 0 ? tick.input : no_input_);
    }
    estimate_.noalias() = tick.nominal.W * heard_.reshaped();
  }

  const Eigen::VectorXd& estimate() const override { return estimate_; }

 private:
  void predict(Eigen::Index sensor, const Eigen::VectorXd& input) {
    BoundedVector next(heard_.rows());
    plant_->advance(heard_.col(sensor), input, next);
    heard_.col(sensor) = next;
  }

  std::shared_ptr<const Plant> plant_;
  Eigen::VectorXd no_input_;
  Eigen::MatrixXd heard_;  ///< states x sensors: what each sensor is thought to estimate
  Eigen::VectorXd estimate_;
};

class ZeroEavesdropper final : public Eavesdropper {
 public:
  explicit ZeroEavesdropper(int states) : estimate_(Eigen::VectorXd::Zero(states)) {}
  std::unique_ptr<Eavesdropper> clone() const override { return std::make_unique<ZeroEavesdropper>(*this); }
  void listen(const PublicTick& /*tick*/, const Eigen::MatrixXd& /*messages*/,
              std::span<const char> /*heard*/) override {}
  const Eigen::VectorXd& estimate() const override { return estimate_; }

 private:
  Eigen::VectorXd estimate_;
};

}  // namespace

std::unique_ptr<Eavesdropper> fusing_eavesdropper(const Knowledge& knowledge) {
  return std::make_unique<FusingEavesdropper>(knowledge);
}

std::unique_ptr<Eavesdropper> zero_eavesdropper(int states) { return std::make_unique<ZeroEavesdropper>(states); }

}  // namespace vigil::privacy
