/// The declared parameters of both observers.
#include "engine/methods/observer/settings.hpp"

namespace vigil::observer {
namespace {

Param override_of(const char* name, const char* symbol, Words meaning) {
  return {.name = name,
          .fallback = nullptr,
          .minimum = 0,
          .exclusive_minimum = true,
          .nullable = true,
          .symbol = symbol,
          .meaning = std::move(meaning)};
}

std::vector<Param> bounds() {
  return {override_of("pmin", "", {"Least eigenvalue of P; none: the preset's", "P 的最小特征值下界；无：取预设值"}),
          override_of("pmax", "", {"Largest eigenvalue of P; none: the preset's", "P 的最大特征值上界；无：取预设值"}),
          override_of("cnu", "", {"Price of large gains; none: the preset's", "大增益的代价；无：取预设值"}),
          override_of("eps", "ε", {"Margin of the inequality; none: the preset's", "不等式裕度；无：取预设值"})};
}

Param vector_of(const char* name, const char* symbol, Words meaning) {
  return {.name = name,
          .type = ParamType::vector,
          .fallback = nullptr,
          .nullable = true,
          .symbol = symbol,
          .meaning = std::move(meaning)};
}

Param weight(const char* name, double fallback, Words meaning) {
  return {.name = name, .fallback = fallback, .minimum = 0, .exclusive_minimum = true, .meaning = std::move(meaning)};
}

}  // namespace

ParamTable intermediate_params() {
  std::vector<Param> all = {
      {.name = "gains",
       .type = ParamType::text,
       .fallback = "design",
       .choices = {"design", "printed", "given", "riccati"},
       .meaning = {"Where the gains come from: the inequality, the source's print, L below, Riccati equations",
                   "增益来源：线性矩阵不等式、原文所印、下面的 L、或 Riccati 方程"}},
      {.name = "preset",
       .type = ParamType::text,
       .fallback = "ref",
       .choices = {"ref", "fast"},
       .meaning = {"Moderate gains, or those that reproduce the figures", "温和的增益，或能复现原图的增益"}},
      {.name = "structure",
       .type = ParamType::text,
       .fallback = "proposed",
       .choices = {"proposed", "classical"},
       .meaning = {"Classical: no innovation drives theta", "经典结构：新息不驱动 theta"}}};
  for (Param& one : bounds()) all.push_back(std::move(one));
  all.push_back(
      override_of("cd", "", {"Price of gamma_d squared; none: the preset's", "gamma_d² 的代价；无：取预设值"}));
  all.push_back(
      override_of("cw", "", {"Price of gamma_w squared; none: the preset's", "gamma_w² 的代价；无：取预设值"}));
  all.push_back(override_of(
      "rmax", "",
      {"Local poles stay above -rmax, 1/s; none: the preset's", "局部极点实部大于 -rmax（1/s）；无：取预设值"}));
  all.push_back(vector_of("kappa", "κ",
                          {"One a subsystem; none: the plant's own, a variable where it has none",
                           "每个子系统一个；无：取对象自身的值，若没有则作为变量"}));
  all.push_back({.name = "free_kappa",
                 .type = ParamType::boolean,
                 .fallback = false,
                 .meaning = {"kappa is a variable of the design", "κ 作为设计变量"}});
  all.push_back(vector_of(
      "mu", "μ",
      {"One a subsystem; none: the plant's own. Only scales L", "每个子系统一个；无：取对象自身的值。仅缩放 L"}));
  all.push_back(vector_of(
      "varsigma", "ς",
      {"N = varsigma D2', one a subsystem; none: the plant's own", "N = ς D2'，每个子系统一个；无：取对象自身的值"}));
  all.push_back({.name = "L",
                 .type = ParamType::matrix,
                 .fallback = nullptr,
                 .nullable = true,
                 .symbol = "L",
                 .meaning = {"Gains of one's own, blocks on the diagonal, where gains is \"given\"",
                             "自定义增益（分块对角），当 gains 为 \"given\" 时使用"}});
  all.push_back(weight("qd", 1e4, {"Riccati: weight of disturbances", "Riccati：扰动权重"}));
  all.push_back(weight("qf", 1e4, {"Riccati: weight of the nonlinearity", "Riccati：非线性权重"}));
  all.push_back(weight("qw", 1e6, {"Riccati: weight of the attack's rate", "Riccati：攻击变化率权重"}));
  return {std::move(all)};
}

ParamTable matched_params() { return {bounds()}; }

}  // namespace vigil::observer
