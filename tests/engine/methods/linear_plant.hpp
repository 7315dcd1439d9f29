/// Doubles for the tests: a linear plant and a linear sensor of any size, neither registered.
#pragma once

#include <string>

#include "engine/world/plant.hpp"
#include "engine/world/sensor.hpp"

namespace vigil::rig {

/// x+ = A x.
class LinearPlant final : public Plant {
 public:
  explicit LinearPlant(Eigen::MatrixXd A) : A_(std::move(A)) {
    for (Eigen::Index i = 0; i < A_.rows(); ++i) state_.push_back({"s" + std::to_string(i), "", 0});
    errors_ = {{"position", {0}, ""}};
  }
  const std::vector<Component>& state() const override { return state_; }
  const std::vector<Component>& input() const override { return input_; }
  const std::vector<ErrorGroup>& errors() const override { return errors_; }
  void advance(const Eigen::Ref<const Eigen::VectorXd>& x, const Eigen::Ref<const Eigen::VectorXd>& /*u*/,
               Eigen::Ref<Eigen::VectorXd> next) const override {
    next = A_ * x;
  }
  void jacobian(const Eigen::Ref<const Eigen::VectorXd>& /*x*/, const Eigen::Ref<const Eigen::VectorXd>& /*u*/,
                Eigen::Ref<Eigen::MatrixXd> F) const override {
    F = A_;
  }

 private:
  Eigen::MatrixXd A_;
  std::vector<Component> state_, input_;
  std::vector<ErrorGroup> errors_;
};

/// z = B x + v, v ~ N(0, R).
class LinearSensor final : public Sensor {
 public:
  LinearSensor(Eigen::MatrixXd B, Eigen::MatrixXd R) : B_(std::move(B)), R_(std::move(R)) {
    for (Eigen::Index i = 0; i < B_.rows(); ++i) channels_.push_back({"c" + std::to_string(i), "", 0});
  }
  const std::vector<Component>& channels() const override { return channels_; }
  const Eigen::MatrixXd& noise() const override { return R_; }
  void measure(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Ref<Eigen::VectorXd> z) const override { z = B_ * x; }
  void jacobian(const Eigen::Ref<const Eigen::VectorXd>& /*x*/, Eigen::Ref<Eigen::MatrixXd> H) const override {
    H = B_;
  }

 private:
  Eigen::MatrixXd B_, R_;
  std::vector<Component> channels_;
};

}  // namespace vigil::rig
