/// A constant vector added to what a link carries or a sensor reads, each step with a probability.
#include "engine/adversary/attack.hpp"
#include "engine/random/draws.hpp"

namespace vigil {
namespace {

class Bias final : public Attack {
 public:
  Bias(const Params& params, const AttackContext& context)
      : probability_(params.real("probability")),
        vector_(params.vector("vector")),
        branch_(context.seed, "adversary." + context.id + ".branch") {
    if (context.on_links) check_size(context.message, "a message");
    for (const int size : context.readings) check_size(size, "what it acts on at a sensor");
    for (const int size : context.actuators) check_size(size, "what it acts on at an actuator");
    if (!context.actuators.empty() && probability_ != 1)
      throw InputError("/probability", "probability is below 1; an actuator is pushed all the time", "1");
  }

  std::unique_ptr<Attack> clone() const override { return std::make_unique<Bias>(*this); }

  void act(std::int64_t k, std::span<const int> links, LinkEffects& effects) const override {
    for (const int link : links) {
      if (branch_.bernoulli(k, static_cast<std::uint32_t>(link), probability_)) effects.inject(link, vector_);
    }
  }

  void tamper(std::int64_t k, std::span<const SensorPlace> places, SensorEffects& effects) const override {
    for (const SensorPlace& place : places) {
      // Sensors draw apart from links: indices from 2^16 on, 64 a node.
      const auto index = static_cast<std::uint32_t>(0x10000 + place.node * 64 + place.channel + 1);
      if (branch_.bernoulli(k, index, probability_)) effects.add(place, vector_, SensorState::fdi);
    }
  }

  /// On an actuator it pushes all the time: a probability a step means nothing in continuous time.
  void push(const ActuatorEffects::Push& /*at*/, double /*t*/, double /*branch*/,
            Eigen::Ref<Eigen::VectorXd> w) const override {
    w += vector_;
  }

  LinkRates rates() const override { return {0, probability_, vector_.norm()}; }

 private:
  void check_size(int expected, const char* what) const {
    if (vector_.size() == expected) return;
    throw InputError("/vector", "vector has " + std::to_string(vector_.size()) + " entries; " + what + " has " +
                                    std::to_string(expected));
  }

  double probability_;
  Eigen::VectorXd vector_;
  Draws branch_;
};

const Registration<AttackMake> registration({
    "bias",
    {"Constant false data", "恒定偏差注入"},
    "seed 000, (5)-(6), gamma alone with a constant vector",
    ParamTable({
        {.name = "vector",
         .type = ParamType::vector,
         .fallback = Json::array({15.0, 15.0, 0.0}),
         .live = true,
         .symbol = "ξ",
         .meaning = {"What is added to the message or the reading", "加到消息或读数上的向量"}},
        {.name = "probability",
         .fallback = 1.0,
         .minimum = 0,
         .maximum = 1,
         .live = true,
         .symbol = "γ̄",
         .meaning = {"Probability that the channel is falsified in a step", "每步信道被注入虚假数据的概率"}},
    }),
    [](const Params& params, const AttackContext& context) -> std::unique_ptr<Attack> {
      return std::make_unique<Bias>(params, context);
    },
    {.acts_on = {ChannelKind::link, ChannelKind::sensor, ChannelKind::actuator}},
});

}  // namespace
}  // namespace vigil
