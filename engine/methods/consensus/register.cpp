/// Registers the consensus filter of seed 000 and picks the kernel that fits.
#include "engine/methods/consensus/filter.hpp"

namespace vigil::consensus {
namespace {

void refuse_large(const Knowledge& knowledge) {
  bool fits = knowledge.plant->states() <= kMaxSmall;
  for (const auto& sensor : knowledge.sensors) fits = fits && sensor->size() <= kMaxSmall;
  if (!fits)
    throw InputError("", "the consensus filter takes plants and sensors of at most 12 states and channels", "<= 12");
}

const Registration<MethodMake> registration({
    "consensus_ekf",
    {"Consensus filter", "共识滤波"},
    "seed 000, (3), (7), (26)-(30)",
    ParamTable({
        {.name = "mode",
         .type = ParamType::text,
         .fallback = "filter",
         .choices = {"filter", "drop", "naive_hold", "naive_zero"},
         .meaning = {"What the receiver knows of an attack: filter sees lost packets; drop discards flagged ones (an "
                     "oracle); naive_hold "
                     "and naive_zero know nothing",
                     "接收端对攻击的了解：filter 知道丢包；drop 丢弃被标记的数据包（需要标记）；naive_hold 与 "
                     "naive_zero 一无所知"}},
        {.name = "tau",
         .fallback = 0.01,
         .minimum = 0,
         .live = true,
         .symbol = "τ",
         .meaning = {"Consensus strength, C = τ Φ(k+1|k)", "共识强度"}},
        {.name = "sigma",
         .fallback = 0.1,
         .minimum = 0,
         .exclusive_minimum = true,
         .live = true,
         .symbol = "σ",
         .meaning = {"Bound parameter of (28)", "条件 (28) 的界参数"}},
        {.name = "beta",
         .fallback = 0.1,
         .minimum = 0,
         .exclusive_minimum = true,
         .live = true,
         .symbol = "β",
         .meaning = {"Bound parameter of (29)", "条件 (29) 的界参数"}},
        {.name = "eps",
         .minimum = 0,
         .exclusive_minimum = true,
         .nullable = true,
         .live = true,
         .symbol = "ε",
         .meaning = {"Young's parameter, below 1/d_max; none given: 0.9/d_max",
                     "Young 不等式参数，小于 1/d_max；未给出时为 0.9/d_max"}},
        {.name = "rho",
         .fallback = 0.9,
         .minimum = 0,
         .maximum = 1,
         .exclusive_minimum = true,
         .exclusive_maximum = true,
         .live = true,
         .symbol = "ρ",
         .meaning = {"Share of the limits that guard clip leaves", "clip 保护保留的界限比例"}},
        {.name = "guard",
         .type = ParamType::text,
         .fallback = "clip",
         .choices = {"clip", "strict", "none", "adapt"},
         .live = true,
         .meaning = {"What happens where (28) or (29) fails: the paper's example fails at step 2",
                     "条件 (28)、(29) 失效时的处理：论文算例在第 2 步即失效"}},
        {.name = "bound",
         .type = ParamType::text,
         .fallback = "paper",
         .choices = {"paper", "corrected", "tight"},
         .live = true,
         .meaning = {"Multipliers of (27): paper is valid for one neighbour only, corrected and tight always",
                     "(27) 的系数：paper 仅对单邻居成立，corrected 与 tight 始终成立"}},
        {.name = "U",
         .type = ParamType::matrix,
         .fallback = 0.01,
         .symbol = "U",
         .meaning = {"Scaling of the linearisation error of f", "f 线性化误差的尺度矩阵"}},
        {.name = "V",
         .type = ParamType::matrix,
         .fallback = 0.1,
         .symbol = "V",
         .meaning = {"Scaling of the linearisation error of h", "h 线性化误差的尺度矩阵"}},
        {.name = "knows_rates",
         .type = ParamType::boolean,
         .fallback = true,
         .live = true,
         .meaning = {"The published attack probabilities and bound are known", "已知公布的攻击概率与范数上界"}},
        {.name = "phibar",
         .minimum = 0,
         .maximum = 1,
         .nullable = true,
         .live = true,
         .symbol = "φ̄",
         .meaning = {"Assumed probability of a DoS; none given: the adversary's",
                     "假定的拒绝服务概率；未给出时跟随攻击者"}},
        {.name = "gammabar",
         .minimum = 0,
         .maximum = 1,
         .nullable = true,
         .live = true,
         .symbol = "γ̄",
         .meaning = {"Assumed probability of false data; none given: the adversary's",
                     "假定的虚假数据概率；未给出时跟随攻击者"}},
        {.name = "delta",
         .minimum = 0,
         .nullable = true,
         .live = true,
         .symbol = "δ",
         .meaning = {"Assumed bound on an injected vector; none given: the adversary's",
                     "假定的注入范数上界；未给出时跟随攻击者"}},
    }),
    [](const Params& params, const Knowledge& knowledge) { return make_filter(params, knowledge); },
});

}  // namespace

std::unique_ptr<Method> make_filter(const Params& params, const Knowledge& knowledge, bool force_bounded) {
  refuse_large(knowledge);
  const auto all_have = [&](int channels) {
    for (const auto& sensor : knowledge.sensors) {
      if (sensor->size() != channels) return false;
    }
    return knowledge.plant->states() == 3 && !force_bounded;
  };
  if (all_have(2)) return std::make_unique<Filter<3, 2>>(params, knowledge);
  if (all_have(3)) return std::make_unique<Filter<3, 3>>(params, knowledge);
  return std::make_unique<Filter<Eigen::Dynamic, Eigen::Dynamic>>(params, knowledge);
}

}  // namespace vigil::consensus
