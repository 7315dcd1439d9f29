/// Plain jamming: a channel carries nothing, each step with a probability.
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

  LinkRates rates() const override { return {probability_, 0, 0}; }

 private:
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
});

}  // namespace
}  // namespace vigil
