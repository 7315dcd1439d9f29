/// Seed 000, figures 4 and 5: tracking, and the errors of the eight filters.
#include <algorithm>
#include <cmath>

#include "engine/papers/consensus.hpp"
#include "engine/papers/curves.hpp"

namespace vigil::papers {
namespace {

constexpr double kMetre = 100;  ///< cm
constexpr int kNodes = 8;
const char* const kPrintedSays = "slight deviations, track kept (a picture)";

std::string signal(int node, const char* what) { return "lane.consensus." + std::to_string(node) + "." + what; }

std::vector<std::string> errors() {
  std::vector<std::string> names;
  for (int i = 1; i <= kNodes; ++i) names.push_back(signal(i, "error"));
  return names;
}

Estimate in_cm(Estimate metres) { return {metres.value * kMetre, metres.se * kMetre}; }

Panel tracks(const Record& record, const char* title, const char* unit) {
  Panel panel{title, {std::string("x (") + unit + ")"}, {std::string("y (") + unit + ")"}, {}};
  panel.series.push_back(series("truth", record.of("truth.x"), record.of("truth.y")));
  for (int i = 1; i <= kNodes; ++i) {
    panel.series.push_back(series("node " + std::to_string(i), record.of(signal(i, "estimate.x")),
                                  record.of(signal(i, "estimate.y")), "dashed", 1));
  }
  return panel;
}

Findings tracking(Laboratory& laboratory) {
  const Scenario printed = preset("consensus-literal", {"consensus"}), ours = preset("consensus", {"consensus"});
  const auto literal = laboratory.campaign(printed), corrected = laboratory.campaign(ours);
  Findings found;
  found.runs = corrected->runs;
  const char* rmse = "network RMSE of the position over 30 steps, cm";
  found.claim(Reading::printed, rmse, kPrintedSays, in_cm(literal->at("consensus", "rmse_position")), 0, 10);
  found.claim(Reading::corrected, rmse, kPrintedSays, corrected->at("consensus", "rmse_position"), 0, 10);
  found.claim(Reading::corrected, "over the last ten steps, cm", kPrintedSays,
              corrected->at("consensus", "rmse_position_last10"), 0, 10);
  found.claim(Reading::noted, "first step at which condition (28) fails", "the conditions hold",
              corrected->at("consensus", "first_infeasible_step"), 31, 1e9);
  std::vector<std::string> names{"truth.x", "truth.y"};
  for (int i = 1; i <= kNodes; ++i) {
    names.push_back(signal(i, "estimate.x"));
    names.push_back(signal(i, "estimate.y"));
  }
  found.panels.push_back(tracks(laboratory.samples(ours, names, 1)->front(), "corrected units", "cm"));
  found.panels.push_back(tracks(laboratory.samples(printed, names, 1)->front(), "as printed", "m"));
  return found;
}

/// RMSE of each node at every step, over runs.
std::vector<std::vector<double>> curves_of(const Records& records) {
  std::vector<std::vector<double>> curves;
  for (const std::string& name : errors()) curves.push_back(rms_curve(records, name));
  return curves;
}

Panel filters(const std::vector<std::vector<double>>& curves, const char* title, const char* unit) {
  Panel panel{title, {"k"}, {std::string("RMSE (") + unit + ")"}, {}};
  for (std::size_t i = 0; i < curves.size(); ++i)
    panel.series.push_back(series("filter " + std::to_string(i + 1), ticks(curves[i].size()), curves[i], "line", 1));
  return panel;
}

double worst_at(const std::vector<std::vector<double>>& curves, std::size_t k) {
  double worst = 0;
  for (const auto& curve : curves) worst = std::max(worst, curve.at(k));
  return worst;
}

double apart_at(const std::vector<std::vector<double>>& curves, std::size_t k) {
  double least = curves.front().at(k);
  for (const auto& curve : curves) least = std::min(least, curve.at(k));
  return worst_at(curves, k) / least;
}

/// Network mean square of a run over these ticks.
std::vector<double> powers(const Records& records, std::size_t from, std::size_t to) {
  return of_runs(records, [&](const Record& record) {
    double sum = 0;
    for (const std::string& name : errors()) {
      for (std::size_t k = from; k <= to; ++k) sum += std::pow(record.at(name, k), 2);
    }
    return sum / (kNodes * static_cast<double>(to - from + 1));
  });
}

Findings filter_errors(Laboratory& laboratory) {
  const Scenario ladder = preset("consensus", {"consensus"});
  const auto literal = laboratory.samples(preset("consensus-literal", {"consensus"}), errors());
  const auto short_runs = laboratory.samples(ladder, errors());
  const auto complete = laboratory.samples(ladder.with("network.graph", "complete"), errors());
  const auto long_runs = laboratory.samples(ladder.with("time.steps", 200), errors());
  const auto printed = curves_of(*literal), ours = curves_of(*short_runs), flat = curves_of(*complete);
  const auto growth = ratio_of(powers(*long_runs, 151, 200), powers(*long_runs, 61, 110));
  Findings found;
  found.runs = static_cast<std::int64_t>(short_runs->size());
  const char* worst = "RMSE of the worst filter at step 30, cm";
  const char* says = "roughly consistent and tending to stable (a picture)";
  found.claim(Reading::printed, worst, says, {worst_at(printed, 30) * kMetre}, 0, 10);
  found.claim(Reading::corrected, worst, says, {worst_at(ours, 30)}, 0, 10);
  found.claim(Reading::corrected, "stable: mean square of steps 151-200 over that of 61-110", "about 1", growth, 0, 2);
  const char* flat_says = "tending to stable";
  found.claim(Reading::noted, "network RMSE at step 1, complete graph, cm", flat_says, root_of(powers(*complete, 1, 1)),
              1, 1.4);
  found.claim(Reading::noted, "network RMSE of the last ten steps, complete graph, cm", flat_says,
              root_of(powers(*complete, 21, 30)), 1.2, 1.7);
  const std::string apart = "worst over best filter at step 30";
  found.claim(Reading::corrected, apart + ", ladder", "roughly consistent", {apart_at(ours, 30)}, 1, 2);
  found.claim(Reading::noted, apart + ", complete graph", "roughly consistent", {apart_at(flat, 30)}, 1, 2);
  found.claim(Reading::noted, "network RMSE at step 10, cm", nullptr, root_of(powers(*short_runs, 10, 10)), 1.5, 3);
  found.claim(Reading::noted, "network RMSE at step 30, cm", nullptr, root_of(powers(*short_runs, 30, 30)), 2.5, 5);
  found.panels = {filters(ours, "corrected units, ladder", "cm"),
                  filters(flat, "corrected units, complete graph", "cm"), filters(printed, "as printed", "m")};
  return found;
}

}  // namespace

std::vector<Item> consensus_tracking_items() {
  return {
      {"000/fig4",
       {"The robot and the eight estimates of its path", "机器人轨迹与八个滤波器的估计"},
       "consensus, sections 2, 6 and 12",
       "consensus",
       "Reproduced where the network RMSE over 30 steps is at most 10 cm with lengths in metres and angles in "
       "radians; after correction where it is with centimetres and degrees.",
       "The source gives no units. Read as metres and radians, Q = I is 1 m of noise a step in a room of 1.8 m and "
       "nothing tracks, not even a centralised filter; centimetres and degrees with every other number as printed "
       "give the picture. The conditions (28) and (29) fail at step 2 of the example, so the guard `clip` is part of "
       "the algorithm. Initial values, U, V and the wheels' inputs are not given.",
       tracking},
      {"000/fig5",
       {"RMSE of the eight filters", "八个滤波器的均方根误差"},
       "consensus, sections 2, 3 and 12",
       "consensus",
       "Reproduced where the worst filter has at most 10 cm at step 30 in the printed reading; after correction of "
       "the units where it has, where 200 steps stay as they are (mean squares of two late windows within a factor "
       "2) and where the worst filter has at most twice the error of the best: roughly consistent.",
       "Units as in figure 4. The picture of the topology is missing. The errors tend to be stable; that the filters "
       "are roughly consistent does not come out: on our ladder they differ several times over at step 30, because "
       "what is left of the heading's error is multiplied by the distance to the camera. On the complete graph the "
       "errors are nearly flat, and still differ about twofold.",
       filter_errors}};
}

}  // namespace vigil::papers
