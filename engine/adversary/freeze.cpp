/// A channel that shows what it showed last before the attack, again and again.
#include <algorithm>

#include "engine/adversary/attack.hpp"

namespace vigil {
namespace {

class Freeze final : public Attack {
 public:
  explicit Freeze(const AttackContext& context) : held_(std::max<std::int64_t>(context.from - 1, 1)) {}

  std::unique_ptr<Attack> clone() const override { return std::make_unique<Freeze>(*this); }
  std::int64_t start() const override { return held_ + 1; }
  bool active(std::int64_t k) const override { return k > held_; }

  void act(std::int64_t /*k*/, std::span<const int> links, LinkEffects& effects) const override {
    for (const int link : links) effects.play(link, {held_, held_, held_});
  }
  void tamper(std::int64_t /*k*/, std::span<const SensorPlace> places, SensorEffects& effects) const override {
    for (const SensorPlace& place : places) effects.play(place, {held_, held_, held_});
  }
  void reach(std::int64_t /*k*/, std::span<const ActuatorPlace> places, ActuatorEffects& effects) const override {
    for (const ActuatorPlace& place : places) effects.stops.push_back({place, true});
  }
  std::string remark() const override { return "what was sent at tick " + std::to_string(held_) + " is held"; }

 private:
  std::int64_t held_;
};

const Registration<AttackMake> registration({
    "freeze",
    {"Freezing", "冻结"},
    "a replay of one tick: seed 003, section 4",
    ParamTable(),
    [](const Params& /*params*/, const AttackContext& context) -> std::unique_ptr<Attack> {
      return std::make_unique<Freeze>(context);
    },
    {.acts_on = {ChannelKind::link, ChannelKind::sensor, ChannelKind::actuator}, .on_commands = true},
});

}  // namespace
}  // namespace vigil
