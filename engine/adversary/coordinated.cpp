/// Several sensors falsified so that they agree: a_i = h_i(x + c) - h_i(x), H_i c where sensors are linear, with one c
/// for all. A test of whether readings fit each other sees nothing. Liu, Ning and Reiter (2011).
#include <algorithm>
#include <string>

#include "engine/adversary/attack.hpp"

namespace vigil {
namespace {

class Coordinated final : public Attack {
 public:
  Coordinated(const Params& params, const AttackContext& context)
      : shift_(params.vector("shift")), grow_(params.integer("grow")), from_(context.from) {
    if (context.continuous)
      throw InputError("", "\"coordinated\" moves readings tick by tick; this plant is in continuous time");
    if (context.single_channels)
      throw InputError("", "\"coordinated\" moves whole readings and was given a single channel", "sensor:NODE");
    if (shift_.size() != context.message)
      throw InputError("/shift", "shift has " + std::to_string(shift_.size()) + " entries; the plant has " +
                                     std::to_string(context.message) + " states");
  }

  std::unique_ptr<Attack> clone() const override { return std::make_unique<Coordinated>(*this); }

  void tamper(std::int64_t k, std::span<const SensorPlace> places, SensorEffects& effects) const override {
    const double share = std::min(1.0, static_cast<double>(k - from_ + 1) / static_cast<double>(grow_));
    for (const SensorPlace& place : places) effects.move(place.node, shift_, share);
  }

 private:
  Eigen::VectorXd shift_;
  std::int64_t grow_, from_;
};

const Registration<AttackMake> registration({
    "coordinated",
    {"Sensors that agree on a false state", "多传感器协同注入"},
    "Liu, Ning and Reiter (2011)",
    ParamTable({
        {.name = "shift",
         .type = ParamType::vector,
         .required = true,
         .live = true,
         .symbol = "c",
         .meaning = {"How far off the state is that the readings agree on, one entry a state",
                     "各读数一致指向的虚假状态偏移，每个状态一个分量"}},
        {.name = "grow",
         .type = ParamType::integer,
         .fallback = 1,
         .unit = "ticks",
         .minimum = 1,
         .meaning = {"It grows to that evenly over so many ticks", "在若干步内均匀增长到该偏移"}},
    }),
    [](const Params& params, const AttackContext& context) -> std::unique_ptr<Attack> {
      return std::make_unique<Coordinated>(params, context);
    },
    {.acts_on = {ChannelKind::sensor}},
});

}  // namespace
}  // namespace vigil
