/// Falsified readings that a chi-square test of innovations does not see: the adversary runs the filter that it expects
/// behind the sensor and keeps its innovation within the test's budget. Murguia and Ruths (2016), zero-alarm attacks.
/// What a lane's own test makes of it depends on how far its filter is from that one.
#include <Eigen/Core>
#include <string>
#include <vector>

#include "engine/adversary/attack.hpp"
#include "engine/linalg/chi_square.hpp"

namespace vigil {
namespace {

class Stealthy final : public Attack {
 public:
  Stealthy(const Params& params, const AttackContext& context) {
    if (context.continuous)
      throw InputError("", "the filter of \"stealthy\" goes in ticks; this plant is in continuous time");
    if (context.single_channels)
      throw InputError("", "\"stealthy\" shapes the innovation of a whole reading and was given a single channel",
                       "sensor:NODE");
    for (const int size : context.readings) add_size(params, size);
  }

  std::unique_ptr<Attack> clone() const override { return std::make_unique<Stealthy>(*this); }

  void tamper(std::int64_t /*k*/, std::span<const SensorPlace> places, SensorEffects& effects) const override {
    for (std::size_t p = 0; p < places.size(); ++p) effects.aim(places[p].node, aims_[p].direction, aims_[p].budget);
  }

 private:
  struct Aim {
    Eigen::VectorXd direction;
    double budget = 0;
  };

  void add_size(const Params& params, int size) {
    Aim aim{Eigen::VectorXd::Ones(size), chi_square_quantile(params.real("quantile"), size)};
    if (params.given("budget")) aim.budget = params.real("budget");
    if (params.given("direction")) aim.direction = params.vector("direction");
    if (aim.direction.size() != size)
      throw InputError("/direction", "direction has " + std::to_string(aim.direction.size()) +
                                         " entries; a sensor that it acts on has " + std::to_string(size) +
                                         " channels");
    if (aim.direction.norm() <= 0)
      throw InputError("/direction", "direction is zero; expected a vector that points somewhere");
    aim.direction.normalize();
    aims_.push_back(std::move(aim));
  }

  std::vector<Aim> aims_;  ///< one a place
};

const Registration<AttackMake> registration({
    "stealthy",
    {"Within the chi-square budget", "卡方预算内的隐蔽注入"},
    "Murguia and Ruths (2016)",
    ParamTable({
        {.name = "quantile",
         .fallback = 0.95,
         .minimum = 0,
         .maximum = 1,
         .exclusive_minimum = true,
         .exclusive_maximum = true,
         .live = true,
         .meaning =
             {"The budget is this quantile of the chi-square law with as many degrees as the sensor has channels",
              "预算取卡方分布的该分位数，自由度为传感器通道数"}},
        {.name = "budget",
         .minimum = 0,
         .nullable = true,
         .live = true,
         .meaning = {"The budget itself: the innovation's square r' S⁻¹ r; none: by the quantile",
                     "直接给定预算，即新息的归一化平方 r' S⁻¹ r；无：由分位数决定"}},
        {.name = "direction",
         .type = ParamType::vector,
         .nullable = true,
         .live = true,
         .meaning = {"Where the normalised innovation points, one entry a channel; none: all channels alike",
                     "归一化新息的方向，每个通道一个分量；无：各通道相同"}},
    }),
    [](const Params& params, const AttackContext& context) -> std::unique_ptr<Attack> {
      return std::make_unique<Stealthy>(params, context);
    },
    {.acts_on = {ChannelKind::sensor}},
});

}  // namespace
}  // namespace vigil
