#include "engine/methods/privacy/two_step_eavesdroppers.hpp"

#include <vector>

#include "engine/methods/privacy/two_step.hpp"

namespace vigil::privacy {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

class DifferencingEavesdropper final : public Eavesdropper {
 public:
  DifferencingEavesdropper(const FusionModel& model, int window)
      : A_(model.A),
        sensors_(static_cast<std::size_t>(model.count()),
                 TwoStepReceiver(MatrixXd::Identity(model.states(), model.states()), window)),
        x_(model.x0.replicate(1, model.count())),
        message_(model.states()),
        guess_(model.states()),
        estimate_(model.x0) {}

  std::unique_ptr<Eavesdropper> clone() const override { return std::make_unique<DifferencingEavesdropper>(*this); }

  void listen(const PublicTick& tick, const MatrixXd& messages, std::span<const char> heard) override {
    for (std::size_t i = 0; i < sensors_.size(); ++i) {
      const auto column = static_cast<Eigen::Index>(i);
      TwoStepReceiver& sensor = sensors_[i];
      message_ = messages.col(column);
      if (tick.k == 0)
        guess_ = x_.col(column);
      else
        guess_.noalias() = A_ * x_.col(column);
      if (!heard[i])
        x_.col(column) = sensor.miss(guess_);
      else if (!sensor.in_step())
        x_.col(column) = sensor.resume(message_, guess_);
      else
        x_.col(column) = sensor.receive(message_);
    }
    estimate_.noalias() = tick.nominal.W * x_.reshaped();
  }
  const VectorXd& estimate() const override { return estimate_; }

 private:
  MatrixXd A_;
  std::vector<TwoStepReceiver> sensors_;
  MatrixXd x_;  ///< states x sensors
  VectorXd message_, guess_, estimate_;
};

class WindowMeanEavesdropper final : public Eavesdropper {
 public:
  WindowMeanEavesdropper(const FusionModel& model, int window)
      : A_(model.A),
        window_(window),
        x_(model.x0.replicate(1, model.count())),
        guess_(model.states()),
        estimate_(model.x0) {}

  std::unique_ptr<Eavesdropper> clone() const override { return std::make_unique<WindowMeanEavesdropper>(*this); }

  void listen(const PublicTick& tick, const MatrixXd& messages, std::span<const char> heard) override {
    for (Eigen::Index i = 0; i < x_.cols(); ++i) {
      if (heard[static_cast<std::size_t>(i)]) {
        x_.col(i) = messages.col(i) / window_;
      } else if (tick.k > 0) {
        guess_.noalias() = A_ * x_.col(i);
        x_.col(i) = guess_;
      }
    }
    estimate_.noalias() = tick.nominal.W * x_.reshaped();
  }
  const VectorXd& estimate() const override { return estimate_; }

 private:
  MatrixXd A_;
  double window_;
  MatrixXd x_;  ///< states x sensors
  VectorXd guess_, estimate_;
};

}  // namespace

std::unique_ptr<Eavesdropper> differencing_eavesdropper(const FusionModel& model, int window) {
  return std::make_unique<DifferencingEavesdropper>(model, window);
}

std::unique_ptr<Eavesdropper> window_mean_eavesdropper(const FusionModel& model, int window) {
  return std::make_unique<WindowMeanEavesdropper>(model, window);
}

}  // namespace vigil::privacy
