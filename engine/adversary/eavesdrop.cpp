/// Listening in: nothing changes on a channel, but what it carries is overheard. Seed 004, chapter 1.
#include "engine/adversary/attack.hpp"
#include "engine/random/draws.hpp"

namespace vigil {
namespace {

class Eavesdrop final : public Attack {
 public:
  Eavesdrop(const Params& params, const AttackContext& context)
      : probability_(params.real("probability")), branch_(context.seed, "adversary." + context.id + ".branch") {}

  std::unique_ptr<Attack> clone() const override { return std::make_unique<Eavesdrop>(*this); }

  void act(std::int64_t k, std::span<const int> links, LinkEffects& effects) const override {
    for (const int link : links) {
      if (branch_.bernoulli(k, static_cast<std::uint32_t>(link), probability_))
        effects.overheard[static_cast<std::size_t>(link)] = 1;
    }
  }

 private:
  double probability_;
  Draws branch_;
};

const Registration<AttackMake> registration({
    "eavesdrop",
    {"Eavesdropping", "窃听"},
    "seed 004, section 1",
    ParamTable({
        {.name = "probability",
         .fallback = 1.0,
         .minimum = 0,
         .maximum = 1,
         .live = true,
         .meaning = {"Probability that a message is overheard", "报文被窃听的概率"}},
    }),
    [](const Params& params, const AttackContext& context) -> std::unique_ptr<Attack> {
      return std::make_unique<Eavesdrop>(params, context);
    },
});

}  // namespace
}  // namespace vigil
