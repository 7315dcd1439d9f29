/// The lanes of seed 001 that share a filter over a window: A1 with and without the game, A2, A4, the extension, and
/// the unprotected filter.
#include <utility>

#include "engine/methods/sparse/filter.hpp"

namespace vigil::sparse {
namespace {

Param switched(const char* name, std::vector<std::string> choices, Words meaning, bool live) {
  const std::string first = choices.front();
  return {.name = name,
          .type = ParamType::text,
          .fallback = first,
          .choices = std::move(choices),
          .live = live,
          .meaning = std::move(meaning)};
}

/// What every lane with a window declares. `startup`: the choices, the default first.
std::vector<Param> with_window(std::vector<std::string> startup, std::vector<Param> own) {
  std::vector<Param> params{
      {.name = "T",
       .type = ParamType::integer,
       .fallback = 6,
       .minimum = 1,
       .maximum = 32,
       .symbol = "T",
       .meaning = {"Readings in the window", "窗口中的读数个数"}},
      {.name = "q",
       .type = ParamType::integer,
       .fallback = 2,
       .minimum = 0,
       .maximum = 12,
       .symbol = "q",
       .meaning = {"Channels of one node that are attacked at most", "单节点至多受攻击的通道数"}},
      switched("startup", std::move(startup),
               {"Until the window is full: predict alone, or update as an ordinary filter",
                "窗口未满时：仅预测，或按普通滤波更新"},
               false),
      switched("window", {"prior", "current", "frozen"},
               {"Linearised along the trajectory through the prior, at the prior, or where each reading was met",
                "线性化位置：沿先验轨迹、在当前先验处，或在各读数到达处"},
               false),
      {.name = "printed_azimuth_row",
       .type = ParamType::boolean,
       .fallback = false,
       .meaning = {"The azimuth's derivative as printed, short of a factor", "采用原文印刷的方位角导数（缺一因子）"}},
      {.name = "report_time",
       .fallback = 5.0,
       .unit = "s",
       .minimum = 0,
       .maximum = 1e4,
       .meaning = {"Where on the target's noise-free way identifiability is reported",
                   "可辨识性报告所取的无噪声轨迹时刻"}}};
  params.insert(params.end(), std::make_move_iterator(own.begin()), std::make_move_iterator(own.end()));
  return params;
}

Param kappa() {
  return {.name = "kappa",
          .fallback = 1.5,
          .minimum = 0,
          .maximum = 1e6,
          .live = true,
          .symbol = "κ",
          .meaning = {"Inflation of the stopping level for process noise and linearisation", "停止阈值的放大系数"}};
}

Param stop() {
  return switched("stop", {"noise", "fixed"},
                  {"Stop at the level of the noise, or always after qT entries", "按噪声水平停止，或固定选取 qT 项"},
                  true);
}

std::vector<Param> game_params() {
  return {switched("form", {"split", "inside"},
                   {"Reading of the printed utility: supports beside the logarithm, or inside it",
                    "效用函数的解读：支撑差异在对数之外或之内"},
                   true),
          {.name = "greedy",
           .type = ParamType::boolean,
           .fallback = false,
           .live = true,
           .meaning = {"Take the best candidate instead of drawing one", "取最优候选而非随机抽取"}},
          {.name = "r",
           .fallback = 2.0,
           .minimum = 0,
           .maximum = 1e6,
           .live = true,
           .symbol = "r",
           .meaning = {"Weight of the attack's size in the utility", "效用中攻击幅值的权重"}},
          {.name = "beta",
           .fallback = 10.0,
           .minimum = 0,
           .maximum = 1e9,
           .live = true,
           .symbol = "β",
           .meaning = {"Learning factor: how sharply the better is preferred", "学习因子"}},
          {.name = "u_floor",
           .fallback = 0.01,
           .minimum = 0,
           .exclusive_minimum = true,
           .live = true,
           .symbol = "U_floor",
           .meaning = {"Floor of the attack's size inside the logarithm", "对数内攻击幅值的下限"}}};
}

std::vector<Param> with_game(std::vector<Param> params) {
  for (Param& param : game_params()) params.push_back(std::move(param));
  return params;
}

std::vector<Param> channels_params() {
  return {
      kappa(),
      {.name = "block_floor",
       .fallback = 1.0,
       .minimum = 0,
       .maximum = 1e9,
       .live = true,
       .meaning = {"Entries below this are taken as none, in the channel's unit", "低于该值的分量视为零（通道单位）"}}};
}

std::vector<Param> gradient_params() {
  return {{.name = "shrink",
           .fallback = 0.2,
           .minimum = 0,
           .maximum = 1,
           .live = true,
           .symbol = "ν",
           .meaning = {"Decrease of the cost that triggers a projection", "触发投影所需的代价下降比例"}},
          {.name = "max_steps",
           .type = ParamType::integer,
           .fallback = 300,
           .minimum = 1,
           .maximum = 100000,
           .live = true,
           .meaning = {"Gradient steps in a window at most", "每窗口最大梯度步数"}},
          switched("projection", {"block", "element"},
                   {"Keep q whole channels, or qT single entries", "保留 q 个完整通道，或 qT 个单项"}, true)};
}

template <MakeReconstructor make, bool game>
std::unique_ptr<Method> filter(const Params& params, const Knowledge& knowledge) {
  return std::make_unique<SparseFilter>(params, knowledge, make, game);
}

using Startup = std::vector<std::string>;
const Startup kPredict{"predict", "update"}, kUpdate{"update", "predict"};

const Registration<MethodMake> omp_game({"omp_game",
                                         {"Matching pursuit and the potential game (A1)", "正交匹配追踪与势博弈 (A1)"},
                                         "seed 001, eqs. (6)-(9)",
                                         ParamTable(with_window(kPredict, with_game({kappa(), stop()}))),
                                         filter<make_omp, true>});

const Registration<MethodMake> omp({"omp_ekf",
                                    {"Matching pursuit at each node alone", "各节点独立的正交匹配追踪"},
                                    "seed 001, eq. (6), without the game",
                                    ParamTable(with_window(kPredict, {kappa(), stop()})),
                                    filter<make_omp, false>});

const Registration<MethodMake> l1({"l1_ekf",
                                   {"Smallest l1 norm by interior point (A2)", "l1 范数最小化（内点法，A2）"},
                                   "seed 001, Sec. 4 (A2)",
                                   ParamTable(with_window(kPredict, {})),
                                   filter<make_l1, false>});

const Registration<MethodMake> gradient({"etpg_ekf",
                                         {"Event-triggered projected gradient (A4)", "事件触发投影梯度法 (A4)"},
                                         "seed 001, Sec. 4 (A4); Shoukry and Tabuada 2016, restated",
                                         ParamTable(with_window(kPredict, gradient_params())),
                                         filter<make_gradient, false>});

const Registration<MethodMake> channels({"omp_game_channels",
                                         {"Whole channels and the potential game (extension)",
                                          "整通道枚举与势博弈（扩展）"},
                                         "specification of seed 001, section 12: not in the source",
                                         ParamTable(with_window(kPredict, with_game(channels_params()))),
                                         filter<make_channels, true>});

const Registration<MethodMake> unprotected({"window_ekf",
                                            {"A filter at each node alone, unprotected", "各节点独立滤波（无防护）"},
                                            "specification of seed 001, section 13, EKF",
                                            ParamTable(with_window(kUpdate, {})),
                                            filter<nullptr, false>});

}  // namespace
}  // namespace vigil::sparse
