/// False data on a radar: range and azimuth of a station. Seed 001, Table 1; specification of seed 001, section 5.
#include <numbers>
#include <optional>

#include "engine/adversary/attack.hpp"
#include "engine/linalg/small.hpp"
#include "engine/random/draws.hpp"

namespace vigil {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

/// I: both redrawn every tick. II: an offset of the range, one azimuth for the whole run. R: the range alone.
class RadarFdi final : public Attack {
 public:
  RadarFdi(const Params& params, const AttackContext& context)
      : spread_(params.real("range_spread")),
        offset_(params.real("range_offset")),
        span_(params.real("azimuth_span")),
        range_(context.seed, "adversary." + context.id + ".range"),
        azimuth_(context.seed, "adversary." + context.id + ".azimuth"),
        psi_draw_(context.seed, "adversary." + context.id + ".psi") {
    const std::string kind = params.text("kind");
    kind_ = kind == "I" ? SensorState::type_i : kind == "II" ? SensorState::type_ii : SensorState::type_r;
    if (params.given("psi")) psi_ = params.real("psi");
    for (const int size : context.readings) {
      if (size >= 2) continue;
      throw InputError("",
                       "radar_fdi falsifies range and azimuth together and was given a single channel; expected a "
                       "whole sensor whose first two channels they are",
                       "sensor:NODE");
    }
  }

  std::unique_ptr<Attack> clone() const override { return std::make_unique<RadarFdi>(*this); }

  void tamper(std::int64_t k, std::span<const SensorPlace> places, SensorEffects& effects) const override {
    for (const SensorPlace& place : places) {
      const auto index = static_cast<std::uint32_t>(place.node);
      BoundedVector e = BoundedVector::Zero(effects.injected[static_cast<std::size_t>(place.node)].size());
      e[0] = spread_ * (2 * range_.uniform(k, index) - 1);
      if (kind_ == SensorState::type_i) e[1] = span_ * azimuth_.uniform(k, index);
      if (kind_ == SensorState::type_ii) {
        e[0] += offset_;
        e[1] = psi_.value_or(kTurn * psi_draw_.uniform(0, index));
      }
      effects.set(place.node, e, kind_);
    }
  }

 private:
  SensorState kind_ = SensorState::type_i;
  double spread_, offset_, span_;
  std::optional<double> psi_;
  Draws range_, azimuth_, psi_draw_;
};

const Registration<AttackMake> registration({
    "radar_fdi",
    {"False range and azimuth", "虚假的距离与方位角"},
    "seed 001, Table 1",
    ParamTable({
        {.name = "kind",
         .type = ParamType::text,
         .fallback = "I",
         .choices = {"I", "II", "R"},
         .live = true,
         .meaning = {"I: range and azimuth redrawn every step; II: offset of the range, one azimuth for the whole run; "
                     "R: the range alone",
                     "I：距离与方位角每步重新抽取；II：距离带偏移，方位角全程不变；R：仅距离"}},
        {.name = "range_spread",
         .fallback = 5.0,
         .unit = "m",
         .minimum = 0,
         .live = true,
         .meaning = {"The range gets a uniform draw of up to this size either way",
                     "距离叠加的均匀分布幅度（正负对称）"}},
        {.name = "range_offset",
         .fallback = 10.0,
         .unit = "m",
         .live = true,
         .meaning = {"Type II: added to the range besides", "II 型：距离另加的偏移"}},
        {.name = "azimuth_span",
         .fallback = kTurn,
         .unit = "rad",
         .minimum = 0,
         .live = true,
         .meaning = {"Type I: the azimuth gets a uniform draw between 0 and this",
                     "I 型：方位角叠加 0 到该值的均匀抽样"}},
        {.name = "psi",
         .unit = "rad",
         .nullable = true,
         .live = true,
         .symbol = "ψ_t",
         .meaning = {"Type II: added to the azimuth; none given: drawn once a node and run in (0, 2π)",
                     "II 型：方位角的恒定偏移；未给出时每次运行每个节点在 (0, 2π) 内抽取一次"}},
    }),
    [](const Params& params, const AttackContext& context) -> std::unique_ptr<Attack> {
      return std::make_unique<RadarFdi>(params, context);
    },
    {.acts_on = {ChannelKind::sensor}},
});

}  // namespace
}  // namespace vigil
