/// Any signal of time on an actuator: the FDI attacks of seed 002's examples. Specification (observer), section 8.
#include "engine/world/interconnected/waveform.hpp"

#include "engine/adversary/attack.hpp"

namespace vigil {
namespace {

class Waveform final : public Attack {
 public:
  explicit Waveform(const Params& params) : gain_(params.real("gain")), signal_(observer::read_pieces(params)) {}

  std::unique_ptr<Attack> clone() const override { return std::make_unique<Waveform>(*this); }
  void push(const ActuatorEffects::Push& /*at*/, double t, double branch,
            Eigen::Ref<Eigen::VectorXd> w) const override {
    w.array() += gain_ * signal_.value(t, branch);
  }

 private:
  double gain_;
  observer::Signal signal_;
};

const Registration<AttackMake> registration({
    "waveform",
    {"A signal on an actuator", "执行器上的攻击信号"},
    "seed 002, w of eq. (1)",
    ParamTable(
        {observer::pieces_param(),
         {.name = "gain", .fallback = 1.0, .live = true, .meaning = {"Scales the whole signal", "整个信号的倍数"}}}),
    [](const Params& params, const AttackContext& /*context*/) -> std::unique_ptr<Attack> {
      return std::make_unique<Waveform>(params);
    },
    {.acts_on = {ChannelKind::actuator}},
});

}  // namespace
}  // namespace vigil
