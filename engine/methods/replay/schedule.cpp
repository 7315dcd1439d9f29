#include "engine/methods/replay/schedule.hpp"

namespace vigil::replay {

std::shared_ptr<const Schedule> Schedule::make(const System& system, const MixedUpdate& update, const Bounds& start,
                                               int most) {
  auto schedule = std::make_shared<Schedule>();
  Bounds bounds = start;
  for (int k = 0; k < most; ++k) {
    Bounds predicted = bounds;
    time_update(system.A, system.P, system.Mw, predicted);
    const auto choice = update.update(predicted.Q, predicted.M);
    if (!choice) return nullptr;
    schedule->settled_ = k > 0 && choice->Q == bounds.Q && choice->M == bounds.M;
    if (schedule->settled_) break;
    schedule->steps_.push_back(*choice);
    bounds = {choice->Q, choice->M};
  }
  return schedule;
}

const GainChoice* Schedule::step(std::int64_t step) const {
  const auto index = static_cast<std::size_t>(step - 1);
  if (index < steps_.size()) return &steps_[index];
  return settled_ ? &steps_.back() : nullptr;
}

}  // namespace vigil::replay
