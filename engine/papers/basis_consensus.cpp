/// Seeds 000 and 001.
#include "engine/papers/basis.hpp"

namespace vigil::papers {
namespace {

Scene consensus(Words name, Json patch = Json::object()) {
  return {std::move(name), "consensus", {"consensus"}, std::move(patch)};
}

Scene literal() { return {{"as printed: metres and radians", "按原文：米与弧度"}, "consensus-literal", {"consensus"}}; }

Scene sparse(Words name, std::vector<std::string> lanes) { return {std::move(name), "sparse", std::move(lanes)}; }

Scene five() { return sparse({"A1 to A5", "A1 至 A5"}, {"omp_game", "l1", "dkf", "etpg", "sdlms"}); }

std::vector<std::string> rivals(std::vector<std::string> first) {
  first.insert(first.end(), {"sparse/1", "sparse/2", "sparse/jacobian", "sparse/4", "sparse/6", "sparse/update",
                             "sparse/7", "sparse/9", "sparse/a2", "sparse/a3", "sparse/a4", "sparse/a5"});
  return first;
}

}  // namespace

std::vector<KeyedBasis> consensus_basis() {
  const Words corrected{"corrected units", "修正单位"};
  const Scene wide =
      consensus({"strengths of variance 9", "强度方差 9"}, {{"adversary", {{"links", {{"params", {{"s_std", 3}}}}}}}});
  const std::vector<std::string> attack{"consensus/6", "consensus/signal"},
      filter{"consensus/43", "consensus/46", "consensus/7",  "consensus/26",
             "consensus/27", "consensus/28", "consensus/30", "consensus/rmse"};
  return {{"000/fig1", {{literal()}, {"consensus/43", "consensus/46", "consensus/6"}}},
          {"000/fig2", {{wide}, attack}},
          {"000/fig3", {{wide}, attack}},
          {"000/fig4", {{consensus(corrected), literal()}, filter}},
          {"000/fig5",
           {{consensus(corrected), consensus({"complete graph", "完全图"}, {{"network", {{"graph", "complete"}}}}),
             consensus({"200 steps", "200 步"}, {{"time", {{"steps", 200}}}}), literal()},
            filter}}};
}

std::vector<KeyedBasis> sparse_basis() {
  const Scene game = sparse({"A1", "A1"}, {"omp_game"});
  return {
      {"001/fig2", {{game}, {"sparse/graph", "sparse/2"}}},
      {"001/fig3", {{five()}, rivals({})}},
      {"001/fig4", {{five()}, rivals({})}},
      {"001/fig5", {{five()}, rivals({})}},
      {"001/fig6", {{game}, {"sparse/4", "sparse/6", "sparse/epsilon", "sparse/update", "sparse/7", "sparse/9"}}},
      {"001/table1", {{sparse({"the attacks of table 1", "表 1 的攻击"}, {"ekf"})}, {"sparse/attacks", "sparse/2"}}},
      {"001/table2", {{five(), sparse({"no sensor at all", "完全不用传感器"}, {"pred"})}, rivals({"sparse/mse"})}}};
}

}  // namespace vigil::papers
