/// The mixed attack of seed 000, (5)-(6): one draw a channel and step, so that DoS and FDI exclude each other.
#include <cmath>

#include "engine/adversary/attack.hpp"
#include "engine/random/draws.hpp"

namespace vigil {
namespace {

class DosFdi final : public Attack {
 public:
  DosFdi(const Params& params, const AttackContext& context)
      : pdos_(params.real("pdos")),
        pfdi_(params.real("pfdi")),
        s_std_(params.real("s_std")),
        constant_(params.boolean("xi_const")),
        direction_(params.vector("xi_dir") * params.real("xi_scale")),
        branch_(context.seed, "adversary." + context.id + ".branch"),
        signal_(context.seed, "adversary." + context.id + ".signal") {
    if (pdos_ + pfdi_ > 1) {
      throw InputError(
          "/pfdi",
          "pdos + pfdi is " + Json(pdos_ + pfdi_).dump() + "; a channel has at most one of the two, so at most 1",
          "pdos + pfdi <= 1");
    }
    if (direction_.size() != context.message) {
      throw InputError("/xi_dir", "xi_dir has " + std::to_string(direction_.size()) + " entries; a message has " +
                                      std::to_string(context.message));
    }
    const double norm = direction_.norm();
    delta_ = params.given("delta") ? params.real("delta") : norm;
    if (delta_ < norm * 0.999) {
      throw InputError("/delta",
                       "delta is " + Json(delta_).dump() + "; the injected vector has norm " + Json(norm).dump() +
                           ", so the bound would not hold",
                       ">= " + Json(norm).dump());
    }
  }

  std::unique_ptr<Attack> clone() const override { return std::make_unique<DosFdi>(*this); }

  void act(std::int64_t k, std::span<const int> links, LinkEffects& effects) const override {
    for (const int link : links) {
      const auto index = static_cast<std::uint32_t>(link);
      const double u = branch_.uniform(k, index);
      const double s = s_std_ * signal_.normal(k, index);  // s_ij, drawn for a DoS too, as its strength
      if (u < pdos_) {
        effects.jam(link);
        effects.strength[link] = s;
      } else if (u < pdos_ + pfdi_) {
        effects.inject(link, direction_, constant_ ? 1.0 : std::sin(s));  // xi_ij = sin(s_ij) xi_dir
        effects.strength[link] = s;
      }
    }
  }

  LinkRates rates() const override { return {pdos_, pfdi_, delta_}; }

 private:
  double pdos_, pfdi_, s_std_, delta_ = 0;
  bool constant_;
  Eigen::VectorXd direction_;
  Draws branch_, signal_;
};

const Registration<AttackMake> registration({
    "dos_fdi",
    {"Jamming or false data, one of the two", "拒绝服务或虚假数据注入（二者择一）"},
    "seed 000, (5)-(6)",
    ParamTable({
        {.name = "pdos",
         .fallback = 0.2,
         .minimum = 0,
         .maximum = 1,
         .live = true,
         .symbol = "φ̄",
         .meaning = {"Probability that a channel is jammed in a step", "每步信道被阻断的概率"}},
        {.name = "pfdi",
         .fallback = 0.2,
         .minimum = 0,
         .maximum = 1,
         .live = true,
         .symbol = "γ̄",
         .meaning = {"Probability that a channel is falsified in a step", "每步信道被注入虚假数据的概率"}},
        {.name = "xi_dir",
         .type = ParamType::vector,
         .fallback = Json::array({1.5, 1.5, 0.0}),
         .live = true,
         .symbol = "ξ",
         .meaning = {"Direction and size of the injected vector", "注入向量的方向与大小"}},
        {.name = "xi_scale",
         .fallback = 1.0,
         .minimum = 0,
         .live = true,
         .meaning = {"Multiplies xi_dir; the bound delta follows unless given",
                     "xi_dir 的倍数；未给出 delta 时随之变化"}},
        {.name = "xi_const",
         .type = ParamType::boolean,
         .fallback = false,
         .live = true,
         .meaning = {"Inject xi_dir itself instead of sin(s) xi_dir", "直接注入 xi_dir，而不是 sin(s)·xi_dir"}},
        {.name = "s_std",
         .fallback = 1.0,
         .minimum = 0,
         .live = true,
         .symbol = "s_ij",
         .meaning = {"Standard deviation of the attack signal (3 in the attack pictures)",
                     "攻击信号的标准差（攻击示意图中为 3）"}},
        {.name = "delta",
         .minimum = 0,
         .nullable = true,
         .live = true,
         .symbol = "δ",
         .meaning = {"Published bound on the norm; none given: the norm of the vector",
                     "公布的范数上界；未给出时为该向量的范数"}},
    }),
    [](const Params& params, const AttackContext& context) -> std::unique_ptr<Attack> {
      return std::make_unique<DosFdi>(params, context);
    },
});

}  // namespace
}  // namespace vigil
