/// False data that grow: start with an offset and add a slope at every tick, up to a limit.
#include <cmath>
#include <limits>

#include "engine/adversary/attack.hpp"

namespace vigil {
namespace {

class Ramp final : public Attack {
 public:
  Ramp(const Params& params, const AttackContext& context)
      : slope_(params.vector("slope")),
        offset_(params.given("offset") ? params.vector("offset") : Eigen::VectorXd::Zero(slope_.size())),
        limit_(params.given("limit") ? params.real("limit") : std::numeric_limits<double>::infinity()),
        from_(context.from) {
    if (offset_.size() != slope_.size())
      throw InputError("/offset", "offset has " + std::to_string(offset_.size()) + " entries; slope has " +
                                      std::to_string(slope_.size()));
    if (context.on_links) check_size(context.message, "a message");
    for (const int size : context.readings) check_size(size, "what it acts on at a sensor");
    for (const int size : context.actuators) check_size(size, "what it acts on at an actuator");
  }

  std::unique_ptr<Attack> clone() const override { return std::make_unique<Ramp>(*this); }

  void act(std::int64_t k, std::span<const int> links, LinkEffects& effects) const override {
    grow(k);
    for (const int link : links) effects.inject(link, value_);
  }
  void tamper(std::int64_t k, std::span<const SensorPlace> places, SensorEffects& effects) const override {
    grow(k);
    for (const SensorPlace& place : places) effects.add(place, value_, SensorState::fdi);
  }
  void push(const ActuatorEffects::Push& at, double /*t*/, double /*branch*/,
            Eigen::Ref<Eigen::VectorXd> w) const override {
    grow(at.k);
    w += value_;
  }

 private:
  void check_size(int expected, const char* what) const {
    if (slope_.size() == expected) return;
    throw InputError("/slope", "slope has " + std::to_string(slope_.size()) + " entries; " + what + " has " +
                                   std::to_string(expected));
  }
  void grow(std::int64_t k) const {
    value_ = offset_ + static_cast<double>(k - from_) * slope_;
    const double norm = value_.norm();
    if (norm > limit_) value_ *= limit_ / norm;
  }

  Eigen::VectorXd slope_, offset_;
  mutable Eigen::VectorXd value_;  ///< of this tick
  double limit_;
  std::int64_t from_;
};

const Registration<AttackMake> registration({
    "ramp",
    {"Growing false data", "斜坡偏差注入"},
    "specification of seed 003, section 6, in its shape",
    ParamTable({
        {.name = "slope",
         .type = ParamType::vector,
         .required = true,
         .meaning = {"What is added more at every tick", "每步增加的向量"}},
        {.name = "offset",
         .type = ParamType::vector,
         .nullable = true,
         .meaning = {"What is added at the first tick; none: nothing", "起始步所加的向量；无：零"}},
        {.name = "limit",
         .fallback = nullptr,
         .minimum = 0,
         .nullable = true,
         .meaning = {"Largest norm of what is added; none: without end", "所加向量的最大范数；无：不限"}},
    }),
    [](const Params& params, const AttackContext& context) -> std::unique_ptr<Attack> {
      return std::make_unique<Ramp>(params, context);
    },
    {.acts_on = {ChannelKind::link, ChannelKind::sensor, ChannelKind::actuator}},
});

}  // namespace
}  // namespace vigil
