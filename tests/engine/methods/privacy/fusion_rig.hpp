/// A fusion lane driven by hand, without a run: plants and sensors of the specification as doubles, the exchange with
/// the centre, and those who listen.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/linalg/covariance.hpp"
#include "engine/methods/fusion_method.hpp"
#include "engine/methods/privacy/landmark_robot.hpp"
#include "engine/methods/privacy/model.hpp"
#include "engine/random/draws.hpp"
#include "engine/run/fault_table.hpp"
#include "tests/engine/methods/rig.hpp"

namespace vigil::rig {

using privacy::FusionModel;
using privacy::LandmarkRobot;

/// What every plant and sensor of this page has alike.
template <class Base>
class Named : public Base {
 public:
  const std::vector<Component>& state() const { return components_; }
  const std::vector<Component>& channels() const { return components_; }
  const std::vector<Component>& input() const { return no_input_; }
  const std::vector<ErrorGroup>& errors() const { return errors_; }

 protected:
  explicit Named(Eigen::Index count) {
    for (Eigen::Index i = 0; i < count; ++i) components_.push_back({"c" + std::to_string(i), "", 0});
    errors_ = {{"position", {0}, ""}};
  }
  std::vector<Component> components_, no_input_;
  std::vector<ErrorGroup> errors_;
};

using Vector = Eigen::Ref<const Eigen::VectorXd>;

class ModelPlant final : public Named<Plant> {
 public:
  explicit ModelPlant(Eigen::MatrixXd A) : Named(A.rows()), A_(std::move(A)) {}
  bool linear() const override { return true; }
  void advance(const Vector& x, const Vector& /*u*/, Eigen::Ref<Eigen::VectorXd> next) const override {
    next.noalias() = A_ * x;
  }
  void jacobian(const Vector& /*x*/, const Vector& /*u*/, Eigen::Ref<Eigen::MatrixXd> F) const override { F = A_; }

 private:
  Eigen::MatrixXd A_;
};

class ModelSensor final : public Named<Sensor> {
 public:
  explicit ModelSensor(privacy::SensorModel model) : Named(model.C.rows()), model_(std::move(model)) {}
  bool linear() const override { return true; }
  const Eigen::MatrixXd& noise() const override { return model_.R; }
  void measure(const Vector& x, Eigen::Ref<Eigen::VectorXd> z) const override { z.noalias() = model_.C * x; }
  void jacobian(const Vector& /*x*/, Eigen::Ref<Eigen::MatrixXd> H) const override { H = model_.C; }

 private:
  privacy::SensorModel model_;
};

class RobotPlant final : public Named<Plant> {
 public:
  RobotPlant() : Named(3) {}
  void advance(const Vector& x, const Vector& /*u*/, Eigen::Ref<Eigen::VectorXd> next) const override {
    next = robot_.move(x);
  }
  void jacobian(const Vector& x, const Vector& /*u*/, Eigen::Ref<Eigen::MatrixXd> F) const override {
    F = robot_.move_jacobian(x);
  }

 private:
  LandmarkRobot robot_;
};

class LandmarkSensor final : public Named<Sensor> {
 public:
  LandmarkSensor(std::size_t index, Eigen::MatrixXd R) : Named(4), index_(index), R_(std::move(R)) {
    for (const std::size_t bearing : {1U, 3U}) components_[bearing].period = 2 * std::acos(-1.0);
  }
  const Eigen::MatrixXd& noise() const override { return R_; }
  void measure(const Vector& x, Eigen::Ref<Eigen::VectorXd> z) const override { z = robot_.observe(index_, x); }
  void jacobian(const Vector& x, Eigen::Ref<Eigen::MatrixXd> H) const override {
    H = robot_.observe_jacobian(index_, x);
  }

 private:
  LandmarkRobot robot_;
  std::size_t index_;
  Eigen::MatrixXd R_;
};

/// Two nodes, a centre, and a common start at `prior`.
inline Knowledge fusion_knowledge(std::shared_ptr<const Plant> plant,
                                  std::vector<std::shared_ptr<const Sensor>> sensors, const Eigen::MatrixXd& Q,
                                  const Eigen::MatrixXd& P0, const Eigen::VectorXd& prior) {
  Knowledge known;
  known.plant = std::move(plant);
  known.sensors = std::move(sensors);
  const auto count = static_cast<int>(known.sensors.size());
  for (int i = 1; i <= count; ++i) known.nodes.push_back(std::to_string(i));
  known.graph = Graph::to_centre(count);
  known.rates.resize(known.graph.links().size());
  known.Q = Q;
  known.P0 = P0;
  known.prior = prior;
  known.estimates = prior.replicate(1, count);
  return known;
}

inline Knowledge knowledge_of_model(const FusionModel& model) {
  std::vector<std::shared_ptr<const Sensor>> sensors;
  for (const auto& sensor : model.sensors) sensors.push_back(std::make_shared<ModelSensor>(sensor));
  const bool stationary = model.P0.size() == 0;
  const Eigen::MatrixXd P0 = stationary ? Eigen::MatrixXd::Identity(model.states(), model.states()) : model.P0;
  Knowledge known =
      fusion_knowledge(std::make_shared<ModelPlant>(model.A), std::move(sensors), model.noise(), P0, model.x0);
  known.stationary = stationary;
  return known;
}

inline Knowledge knowledge_of_robot() {
  const auto noise = privacy::landmark_noise();
  std::vector<std::shared_ptr<const Sensor>> sensors;
  for (std::size_t i = 0; i < 2; ++i) sensors.push_back(std::make_shared<LandmarkSensor>(i, noise.R[i]));
  return fusion_knowledge(std::make_shared<RobotPlant>(), std::move(sensors), noise.Q, noise.P0,
                          Eigen::Vector3d::Zero());
}

/// Draws the initial state and, where all start in the stationary law, the initial estimates.
inline Eigen::VectorXd start(Knowledge& known, std::uint64_t seed) {
  const int n = known.plant->states();
  const auto stacked = n * static_cast<Eigen::Index>(known.sensors.size());
  if (!known.stationary) {
    Eigen::VectorXd draw(n);
    Draws(seed, "initial").normals(0, draw);
    return known.prior + symmetric_root(known.P0) * draw;
  }
  const FusionModel model = privacy::fusion_model(known);
  const Eigen::MatrixXd P = privacy::stationary_filters(model)->P;
  Eigen::MatrixXd joint(n + stacked, n + stacked);
  joint.topLeftCorner(n, n) = *privacy::state_covariance(model);
  joint.bottomRightCorner(stacked, stacked) = P;
  for (Eigen::Index at = n; at < joint.rows(); at += n) {
    joint.block(at, 0, n, n) = P.block(at - n, at - n, n, n);
    joint.block(0, at, n, n) = P.block(at - n, at - n, n, n);
  }
  Eigen::VectorXd draw(joint.rows());
  Draws(seed, "initial").normals(0, draw);
  const Eigen::VectorXd deviation = symmetric_root(joint) * draw;
  const Eigen::VectorXd truth = known.prior + deviation.head(n);
  known.estimates =
      (truth.replicate(known.estimates.cols(), 1) - deviation.tail(stacked)).reshaped(n, known.estimates.cols());
  return truth;
}

/// One with its declared parameters; not yet in any lane.
inline std::shared_ptr<const privacy::Protection> protect(const Knowledge& known, const std::string& id,
                                                          const Json& params = Json::object()) {
  return Registry<ProtectionMake>::find(id)->make(completed<ProtectionMake>(id, params), known);
}

inline std::unique_ptr<Method> fusion_lane(const Knowledge& known, const char* filter) {
  return Registry<MethodMake>::find("fusion")->make(completed("fusion", {{"filter", filter}}), known);
}

/// What happens to a run: nothing, unless it says so.
struct Events {
  std::function<bool(std::int64_t k, int node)> lost = [](std::int64_t, int) { return false; };
  std::function<bool(std::int64_t k, int node)> jammed = [](std::int64_t, int) { return false; };
};

/// Runs a lane from tick 0 to `last`; watch(k, truth, method, messages as sent) after every tick.
template <class Watch>
void drive(Method& lane, const Knowledge& known, Eigen::VectorXd truth, std::int64_t last, std::uint64_t seed,
           const Events& events, Watch watch) {
  const int n = known.plant->states();
  const auto count = static_cast<int>(known.sensors.size());
  const Draws plant(seed, "plant");
  const Eigen::MatrixXd root = symmetric_root(known.Q);
  const Eigen::VectorXd input(0);
  Eigen::VectorXd draw(n), next(n);
  Eigen::MatrixXd messages(n, count);
  std::vector<Delivery> inbox(static_cast<std::size_t>(count));
  FaultTable faults;
  for (std::int64_t k = 0; k <= last; ++k) {
    faults.begin_tick(k);
    Readings readings;
    if (k > 0) {
      plant.normals(k, draw);
      known.plant->advance(truth, input, next);
      truth = next + root * draw;
      readings = readings_at(known, truth, seed, k);
      for (int i = 0; i < count; ++i) {
        if (events.jammed(k, i)) readings[static_cast<std::size_t>(i)].setConstant(std::nan(""));
      }
      lane.predict(input, faults);
      lane.measure(readings, faults);
    }
    for (int i = 0; i < count; ++i) {
      lane.send(i, messages.col(i));
      auto& delivery = inbox[static_cast<std::size_t>(i)];
      delivery.lost = events.lost(k, i);
      delivery.payload = messages.col(i);
      if (delivery.lost) delivery.payload.setConstant(std::nan(""));
    }
    lane.update(readings, inbox, faults);
    ASSERT_FALSE(faults.stopped());
    watch(k, truth, lane, messages);
  }
}

/// Mean and standard error of a figure that every run gives once.
struct Sample {
  double sum = 0, squares = 0;
  int count = 0;
  void add(double value) { sum += value, squares += value * value, ++count; }
  double mean() const { return sum / count; }
  double error() const { return std::sqrt((squares / count - mean() * mean()) / (count - 1)); }
};

}  // namespace vigil::rig
