/// Seeds 002 and 003.
#include "engine/papers/basis.hpp"
#include "engine/papers/replay.hpp"

namespace vigil::papers {
namespace {

Scene areas(Words name, int number, bool second_attacked) {
  return {std::move(name),
          "observer-areas",
          {"intermediate_fast", "matched_uio"},
          {{"plant", {{"params", {{"case", number}}}}}, {"adversary", {{"area2", {{"enabled", second_attacked}}}}}}};
}

/// One run a case of the attack.
std::vector<Scene> cases(const char* preset, const std::vector<std::string>& lanes) {
  return {{{"case 1", "情形 1"}, preset, lanes, replay_case(1)}, {{"case 2", "情形 2"}, preset, lanes, replay_case(2)}};
}

Scene calm(Words name, const char* preset, std::vector<std::string> lanes, Json patch = Json::object()) {
  patch["adversary"] = {{"replay", nullptr}};
  return {std::move(name), preset, std::move(lanes), std::move(patch)};
}

Scene skewed(const char* law) {
  return calm({std::string("noise law ") + law, std::string("噪声分布 ") + law}, "replay-mixed", {"as_written"},
              {{"noise", {{"law", law}}}});
}

}  // namespace

std::vector<KeyedBasis> observer_basis() {
  const Scene pair{{"two subsystems", "两个子系统"}, "observer-pair", {"intermediate_fast", "intermediate_printed"}};
  const Scene single{{"subsystem 2 alone", "仅子系统 2"},
                     "observer-single",
                     {"intermediate_ref", "intermediate_fast", "classical_ref", "classical_fast"}};
  const Scene one = areas({"case 1", "情形 1"}, 1, false), two = areas({"case 2", "情形 2"}, 2, false),
              attacked = areas({"case 2, area 2 attacked, too", "情形 2，区域 2 也受攻击"}, 2, true);
  const std::vector<std::string> proposed{"observer/1",  "observer/6",    "observer/9",  "observer/16",
                                          "observer/17", "observer/cost", "observer/rms"};
  std::vector<std::string> matched = proposed, classical = proposed;
  matched.emplace_back("observer/matched");
  classical.emplace_back("observer/classical");
  return {{"002/fig2", {{pair}, proposed}},         {"002/fig3", {{pair}, proposed}},
          {"002/fig5", {{one}, matched}},           {"002/fig6", {{two, attacked}, proposed}},
          {"002/fig7", {{two, attacked}, matched}}, {"002/fig8", {{single}, classical}}};
}

std::vector<KeyedBasis> replay_basis() {
  const Json sharp = {{"lanes", {{"gmeekf", {{"params", {{"alpha", 3.0}, {"beta", 2.0}, {"form", "square"}}}}}}}};
  const Words peaceful{"without an attack", "无攻击"};
  const std::vector<std::string> filter{"replay/1", "replay/5", "replay/12"},
      detector{"replay/1", "replay/12", "replay/25", "replay/27", "replay/lasts", "replay/attack", "replay/29"},
      blind{"replay/1", "replay/12", "replay/corner", "replay/25", "replay/27", "replay/attack"};
  const auto with = [](std::vector<std::string> list, const std::vector<std::string>& more) {
    list.insert(list.end(), more.begin(), more.end());
    return list;
  };
  return {{"003/fig1",
           {{calm({"without an attack, alpha 3, beta 2", "无攻击，α = 3，β = 2"}, "replay-nongaussian",
                  {"as_written", "gmeekf"}, sharp)},
            with(filter, {"replay/gmeekf", "replay/peak"})}},
          {"003/fig2", {cases("replay-nongaussian", {"as_written", "repaired", "fixed_norm"}), detector}},
          {"003/fig3",
           {{calm(peaceful, "replay-ubb", {"as_written", "zonotope"})},
            with(filter, {"replay/corner", "replay/zonotope", "replay/peak"})}},
          {"003/fig4", {cases("replay-ubb", {"as_written", "repaired", "fixed_norm"}), blind}},
          {"003/fig5",
           {cases("replay-ubb", {"as_written", "eq29_freeze", "repaired", "zonotope"}),
            with(blind, {"replay/29", "replay/zonotope", "replay/accuracy"})}},
          {"003/fig6", {{skewed("gmix"), skewed("skewmix")}, filter}},
          {"003/fig7", {cases("replay-mixed", {"as_written", "eq29_freeze", "repaired", "fixed_norm"}), detector}}};
}

}  // namespace vigil::papers
