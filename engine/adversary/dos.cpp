/// Plain jamming: a channel carries nothing, each step with a probability. A reading is missing then, a command none.
#include "engine/adversary/attack.hpp"
#include "engine/random/draws.hpp"

namespace vigil {
namespace {

class Dos final : public Attack {
 public:
  Dos(const Params& params, const AttackContext& context)
      : probability_(params.real("probability")), branch_(context.seed, "adversary." + context.id + ".branch") {}

  std::unique_ptr<Attack> clone() const override { return std::make_unique<Dos>(*this); }

  void act(std::int64_t k, std::span<const int> links, LinkEffects& effects) const override {
    for (const int link : links) {
      if (branch_.bernoulli(k, static_cast<std::uint32_t>(link), probability_)) effects.jam(link);
    }
  }

  void tamper(std::int64_t k, std::span<const SensorPlace> places, SensorEffects& effects) const override {
    for (const SensorPlace& place : places) {
      if (strikes(k, kSensors, place)) effects.jam(place);
    }
  }
  void reach(std::int64_t k, std::span<const ActuatorPlace> places, ActuatorEffects& effects) const override {
    for (const ActuatorPlace& place : places) {
      if (strikes(k, kActuators, place)) effects.stops.push_back({place, false});
    }
  }

  LinkRates rates() const override { return {probability_, 0, 0}; }

 private:
  static constexpr std::uint32_t kSensors = 0x10000, kActuators = 0x20000;  // they draw apart from links
  bool strikes(std::int64_t k, std::uint32_t first, const SensorPlace& place) const {
    return branch_.bernoulli(k, first + static_cast<std::uint32_t>(place.node * 64 + place.channel + 1), probability_);
  }

  double probability_;
  Draws branch_;
};

const Registration<AttackMake> registration({
    "dos",
    {"Jamming", "拒绝服务"},
    "seed 000, (5)-(6), phi alone",
    ParamTable({
        {.name = "probability",
         .fallback = 1.0,
         .minimum = 0,
         .maximum = 1,
         .live = true,
         .symbol = "φ̄",
         .meaning = {"Probability that the channel is jammed in a step", "每步信道被阻断的概率"}},
    }),
    [](const Params& params, const AttackContext& context) -> std::unique_ptr<Attack> {
      return std::make_unique<Dos>(params, context);
    },
    {.acts_on = {ChannelKind::link, ChannelKind::sensor, ChannelKind::actuator}, .on_commands = true},
});

}  // namespace
}  // namespace vigil
