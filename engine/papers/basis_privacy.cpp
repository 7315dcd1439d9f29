/// Seed 004.
#include "engine/papers/basis.hpp"
#include "engine/papers/privacy.hpp"

namespace vigil::papers {
namespace {

const Words kCorrected{"corrected", "修正后"}, kPrinted{"as printed", "按原文"};

Scene linear(const Words& name, const Json& patch = Json::object()) {
  return {name, "privacy-robot-linear", {"contamination"}, patch};
}

Scene noise(Words name, const char* channel) {
  return {std::move(name),
          "privacy-robot-linear",
          {"complex_noise"},
          protection("complex_noise", {{"channel", channel}, {"power", 5.6097}})};
}

Scene landmarks(const Words& name, bool printed) {
  return {name,
          "privacy-robot-nonlinear",
          {"contamination"},
          {{"lanes", {{"contamination", {{"params", {{"printed_jacobian", printed}}}}}}}}};
}

Scene turn(Words name, std::vector<std::string> lanes, const Json& patch = Json::object()) {
  return {std::move(name), "privacy-turn", std::move(lanes), patch};
}

Scene uniform(Words name, const Json& params) {
  return turn(std::move(name), {"dp_uniform"}, protection("dp_uniform", params));
}

Scene engine(const Words& name, std::vector<std::string> lanes, const Json& patch = Json::object()) {
  return {name, "privacy-engine", std::move(lanes), patch};
}

std::vector<KeyedBasis> robots() {
  const Scene unrestricted = linear({"as printed: two components, unrestricted", "按原文：两个分量，不加限制"},
                                    protection("contamination", {{"m", 2}, {"bounded_check", false}}));
  const std::vector<std::string> linear_robot{"privacy/2-1",  "privacy/2-11", "privacy/2-12", "privacy/2-14",
                                              "privacy/2-21", "privacy/2-23", "privacy/2-30", "privacy/mse"},
      eavesdropper{"privacy/2-14", "privacy/2-26", "privacy/noise", "privacy/mse"},
      nonlinear{"privacy/2-4",  "privacy/2-52", "privacy/2-12", "privacy/2-14",
                "privacy/2-23", "privacy/2-30", "privacy/mse"};
  const std::vector<Scene> both{landmarks(kCorrected, false), landmarks(kPrinted, true)};
  return {{"004/fig2-2", {{linear(kCorrected), unrestricted}, linear_robot}},
          {"004/fig2-3", {{linear(kCorrected), unrestricted}, linear_robot}},
          {"004/fig2-4",
           {{linear({"contamination", "分量污染"}),
             noise({"artificial noise, fading channel", "人工噪声，衰落信道"}, "fading"),
             noise({"artificial noise, static channel", "人工噪声，静态信道"}, "static")},
            eavesdropper}},
          {"004/fig2-5", {both, nonlinear}},
          {"004/fig2-6", {both, nonlinear}},
          {"004/fig2-7", {both, nonlinear}}};
}

std::vector<KeyedBasis> turning_target() {
  const Scene plain = turn({"noise at both sensors", "两个传感器均加噪"}, {"dp_uniform"});
  const std::vector<std::string> mechanism{"privacy/3-8",  "privacy/2-12", "privacy/3-16",
                                           "privacy/3-10", "privacy/3-23", "privacy/3-26"};
  std::vector<std::string> errors = mechanism, neighbours = mechanism;
  errors.emplace_back("privacy/mse");
  neighbours.emplace_back("privacy/loss");
  return {
      {"004/fig3-3", {{turn({"both shares of the noise", "两种噪声分配"}, {"dp_uniform", "dp_one_sensor"})}, errors}},
      {"004/fig3-4",
       {{uniform({"kappa 5", "κ = 5"}, {{"kappa", 5}}), uniform({"kappa 40", "κ = 40"}, {{"kappa", 40}})}, errors}},
      {"004/fig3-5",
       {{uniform({"epsilon 0.3", "ε = 0.3"}, {{"epsilon", 0.3}}), uniform({"epsilon 2", "ε = 2"}, {{"epsilon", 2.0}})},
        errors}},
      {"004/fig3-6", {{plain}, neighbours}},
      {"004/fig3-7", {{plain}, neighbours}}};
}

std::vector<KeyedBasis> engines() {
  const std::vector<std::string> lanes{"two_step", "contamination", "secrecy_code_a"}, two{"two_step"};
  const Scene all = engine({"all strategies", "全部策略"}, lanes),
              printed = engine({"as printed: one term too many", "按原文：多求和一项"}, two,
                               protection("two_step", {{"sum", "printed"}}));
  const std::vector<std::string> messages{"privacy/4-11", "privacy/4-18", "privacy/4-20", "privacy/code"};
  std::vector<std::string> users = messages, eavesdroppers = messages, index = messages;
  users.emplace_back("privacy/mse");
  eavesdroppers.insert(eavesdroppers.end(), {"privacy/4-24", "privacy/mse"});
  index.insert(index.begin(), "privacy/4-10");
  return {{"004/fig4-2", {{all, printed}, users}},
          {"004/fig4-3",
           {{all, engine({"q_alpha 0.04", "q_α = 0.04"}, two, protection("two_step", {{"q_alpha", 0.04}}))},
            eavesdroppers}},
          {"004/fig4-4",
           {{engine({"two-step", "两步噪声"}, two)}, {"privacy/4-11", "privacy/4-14", "privacy/3-16", "privacy/loss"}}},
          {"004/eq4-33",
           {{engine({"fusion without protection", "无保护的融合"}, {"unprotected"})}, {"privacy/3-8", "privacy/2-12"}}},
          {"004/ci", {{all, printed}, index}}};
}

}  // namespace

std::vector<KeyedBasis> privacy_basis() {
  std::vector<KeyedBasis> list;
  for (const auto& part : {robots(), turning_target(), engines()}) list.insert(list.end(), part.begin(), part.end());
  return list;
}

}  // namespace vigil::papers
