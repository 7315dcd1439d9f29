#include "engine/run/lane_flow.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/missing.hpp"

namespace vigil {
namespace {

/// The known inputs among the drives, in the order of Plant::input().
void pick_inputs(const ContinuousPlant& plant, const Eigen::VectorXd& v, Eigen::VectorXd& u) {
  Eigen::Index entry = 0;
  for (const DrivePorts& ports : plant.ports()) {
    for (int c = 0; c < ports.u; ++c) u[entry++] = v[ports.first + c];
  }
}

}  // namespace

LaneFlow::LaneFlow(const World& world, const ContinuousMethod& method)
    : dt_(world.dt),
      steps_(observer::steps_per_tick(world.dt, std::max(world.continuous()->fastest(), method.fastest()))),
      both_(world.plant->states() + method.flow_state().size()),
      alone_(method.flow_state().size()),
      state_(world.plant->states() + method.flow_state().size()),
      v_(world.continuous()->drives()),
      u_(world.plant->inputs()),
      y_(world.continuous()->outputs()),
      now_(Eigen::VectorXd::Zero(y_.size())),
      last_(now_),
      shift_(now_) {}

void LaneFlow::hear(const Readings& heard) {
  last_ = now_;
  Eigen::Index at = 0;
  for (const Eigen::VectorXd& reading : heard) {
    for (const double value : reading) {
      if (std::isfinite(value)) now_[at] = value;
      ++at;
    }
  }
}

void LaneFlow::begin(const Readings& heard, const Eigen::VectorXd& input, ContinuousMethod& method) {
  hear(heard);
  last_ = now_;
  for (Eigen::Index c = 0; c < u_.size(); ++c) u_[c] = std::isfinite(input[c]) ? input[c] : 0;
  method.settle(now_, u_);
}

bool LaneFlow::follow(const World& world, std::int64_t k, bool attacked, const Course& course, const Readings& heard,
                      ContinuousMethod& method) {
  const ContinuousPlant& plant = *world.continuous();
  const ActuatorEffects* pushes = attacked ? &world.actuators : nullptr;
  hear(heard);
  plant.output(course.truth, course.drives, y_);
  Eigen::Index at = 0;
  for (const Eigen::VectorXd& reading : heard) {
    for (const double value : reading) {
      shift_[at] = std::isfinite(value) ? value - y_[at] : kMissing;
      ++at;
    }
  }
  Eigen::VectorXd& z = method.flow_state();
  const Eigen::Index n = course.past.size();
  state_ << course.past, z;
  const double h = step(), start = static_cast<double>(k - 1) * dt_;
  for (int one = 0; one < steps_; ++one) {
    both_.step(state_, start + one * h, h, [&](double time, double branch, const Eigen::VectorXd& s, auto slope) {
      world.drive.read(time, branch, pushes, v_);
      plant.slope(s.head(n), v_, slope.head(n));
      plant.output(s.head(n), v_, y_);
      for (Eigen::Index c = 0; c < y_.size(); ++c) y_[c] = std::isfinite(shift_[c]) ? y_[c] + shift_[c] : now_[c];
      pick_inputs(plant, v_, u_);
      method.slope(s.tail(s.size() - n), y_, u_, slope.tail(s.size() - n));
    });
  }
  z = state_.tail(z.size());
  pick_inputs(plant, course.drives, u_);
  method.settle(now_, u_);
  return z.allFinite();
}

bool LaneFlow::follow_trace(std::int64_t k, const Readings& heard, const Eigen::VectorXd& input,
                            ContinuousMethod& method) {
  hear(heard);
  Eigen::VectorXd& z = method.flow_state();
  for (Eigen::Index c = 0; c < u_.size(); ++c) u_[c] = std::isfinite(input[c]) ? input[c] : 0;
  const double h = step(), start = static_cast<double>(k - 1) * dt_;
  for (int one = 0; one < steps_; ++one) {
    alone_.step(z, start + one * h, h, [&](double time, double, const Eigen::VectorXd& s, auto slope) {
      const double share = (time - start) / dt_;
      y_ = (1 - share) * last_ + share * now_;
      method.slope(s, y_, u_, slope);
    });
  }
  method.settle(now_, u_);
  return z.allFinite();
}

}  // namespace vigil
