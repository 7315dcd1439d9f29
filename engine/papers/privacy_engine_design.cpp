/// Seed 004, figure 4-4, the gains and weights (4-33) and the confidentiality index.
#include <cmath>
#include <limits>

#include "engine/methods/privacy/lmv_fusion.hpp"
#include "engine/methods/privacy/local_filters.hpp"
#include "engine/papers/privacy.hpp"

namespace vigil::papers {
namespace {

const char* const kId = "privacy-engine";
constexpr std::size_t kWindow = 5;  ///< terms of a message's sum
const std::vector<std::string> kStates{"x1", "x2", "x3"};

std::string sent(const char* node, const std::string& state) {
  return std::string("lane.two_step.") + node + ".sent." + state;
}
std::string local(const char* node, const std::string& state) {
  return std::string("lane.two_step.") + node + ".estimate." + state;
}

/// Root mean square of the noise in a message over late ticks: what is left when the window's estimates are taken away.
Estimate noise_of(const Records& records, const char* node, const std::string& state) {
  return root_of(of_runs(records, [&](const Record& r) {
    double sum = 0, count = 0;
    for (std::size_t k = 2 * kWindow; k < r.ticks(); k += kWindow) {
      const double window = kWindow * over_ticks(r, local(node, state), k + 1 - kWindow, k);
      sum += std::pow(r.at(sent(node, state), k) - window, 2);
      ++count;
    }
    return sum / count;
  }));
}

Findings neighbours(Laboratory& laboratory) {
  const Scenario scenario = preset(kId, {"two_step"});
  std::vector<std::string> signals;
  for (const char* node : {"1", "2"}) {
    for (const std::string& state : kStates) {
      signals.push_back(sent(node, state));
      signals.push_back(local(node, state));
    }
  }
  const auto records = laboratory.samples(scenario, signals);
  const auto study = laboratory.campaign(scenario, 2);
  Findings found;
  found.runs = static_cast<std::int64_t>(records->size());
  double widest = 0;
  for (const Json& release : study->design["two_step"]["releases"]) {
    const auto node = release["node"].get<std::string>(), state = release["component"].get<std::string>();
    const double design = release["std"].get<double>(), shift = release["shift"].get<double>();
    const Estimate std = noise_of(*records, node.c_str(), state);
    found.claim(Reading::corrected, "noise measured in messages over the design's, sensor " + node + ", " + state,
                "nearly overlapping (a picture)", {std.value / design, std.se / design}, 0.94, 1.06);
    widest = std::max(widest, shift / std.value);
    found.panels.push_back(
        {"sensor " + node + ", " + state,
         {"message less its mean"},
         {"density"},
         {normal("one trajectory", 0, std.value), normal("its neighbour", shift, std.value, "dashed")}});
  }
  found.claims.insert(found.claims.begin(), {Reading::corrected,
                                             "largest shift between neighbours over the noise measured",
                                             "nearly overlapping (a picture)",
                                             {widest},
                                             0,
                                             0.6});
  return found;
}

/// (4-33) as the source prints it: K_1, K_2, then W by rows.
constexpr double kPrinted[] = {0.03, 0.32, -0.10, 0.06,  0.44, -0.16, 0.19,  0.00,  0.00, 0.81, 0.00, 0.00,
                               0.16, 0.21, 0.12,  -0.16, 0.79, -0.12, -0.03, -0.01, 0.16, 0.03, 0.01, 0.84};

std::vector<double> gains_and_weights(const privacy::FusionModel& model) {
  std::vector<double> numbers;
  const auto filters = privacy::stationary_filters(model);
  if (!filters) return numbers;
  for (const auto& gain : filters->gains) numbers.insert(numbers.end(), gain.K.data(), gain.K.data() + gain.K.size());
  const Eigen::MatrixXd W = privacy::fuse(filters->P, model.states()).W.transpose();
  numbers.insert(numbers.end(), W.data(), W.data() + W.size());
  return numbers;
}

Findings printed_numbers(Laboratory& /*laboratory*/) {
  const auto ours = gains_and_weights(privacy::engine_model());
  Findings found;
  found.runs = 0;
  double off = ours.size() == std::size(kPrinted) ? 0 : std::numeric_limits<double>::infinity(), agree = 0;
  Series theirs{"printed", {}, {}, "points"}, mine{"ours", {}, {}, "stems"};
  for (std::size_t i = 0; i < ours.size() && i < std::size(kPrinted); ++i) {
    off = std::max(off, std::abs(ours[i] - kPrinted[i]));
    agree += std::abs(ours[i] - kPrinted[i]) <= 0.005 ? 1 : 0;
    for (Series* one : {&theirs, &mine}) one->x.push_back(static_cast<double>(i + 1));
    theirs.y.push_back(kPrinted[i]);
    mine.y.push_back(ours[i]);
  }
  found.claim(Reading::corrected, "numbers of 24 that agree to the two digits printed", 24, {agree}, 24, 24);
  found.claim(Reading::corrected, "largest difference from a printed number", 0, {off}, 0, 0.005);
  const char* names[] = {"K1 (1)", "K2 (2)", "W (1,1)", "W (3,6)"};
  const std::size_t places[] = {0, 4, 6, 23};
  for (std::size_t i = 0; i < 4 && ours.size() == std::size(kPrinted); ++i)
    found.claim(Reading::noted, names[i], kPrinted[places[i]], {ours[places[i]]}, kPrinted[places[i]] - 0.005,
                kPrinted[places[i]] + 0.005);
  found.panels.push_back({"K1, K2 and W by rows", {"number"}, {"value"}, {std::move(mine), std::move(theirs)}});
  return found;
}

Panel index_panel(Laboratory& laboratory, const std::vector<std::string>& lanes) {
  Panel panel{"confidentiality index by covariances, one run", {"t"}, {"CI"}, {}};
  std::vector<std::string> signals;
  for (const std::string& lane : lanes) signals.push_back("lane." + lane + ".ci");
  const auto one = laboratory.samples(preset(kId, lanes), signals, 1);
  for (const std::string& lane : lanes)
    panel.series.push_back(series(lane, one->front().time, one->front().of("lane." + lane + ".ci"), "line", 1));
  return panel;
}

Findings index(Laboratory& laboratory) {
  const std::vector<std::string> lanes{"two_step", "contamination", "secrecy_code_a"};
  const auto study = laboratory.campaign(preset(kId, lanes));
  const Scenario shorter = preset(kId, {"two_step"}).with("time.steps", 100);
  const auto early = laboratory.campaign(shorter);
  const auto printed = laboratory.campaign(preset(kId, {"two_step"}, protection("two_step", {{"sum", "printed"}})));
  Findings found;
  found.runs = study->runs;
  const auto exact = [](const Study& from, const char* lane, const char* variant) -> Estimate {
    return {from.at(lane, "ci", "", variant).value};  // from covariances: nothing random in it
  };
  const auto pooled = [](const Study& from, const char* lane, const char* variant) {
    return from.at(lane, "ci_mse", "", variant);
  };
  const Estimate two = exact(*study, "two_step", "differencing");
  found.claim(Reading::printed, "two-step, by errors, printed sums", "infinite (a limit)",
              pooled(*printed, "two_step", "differencing"), 4, 64);
  found.claim(Reading::corrected, "contamination: rank relatively low", 1.23, exact(*study, "contamination", "fusing"),
              1, 2);
  found.claim(Reading::corrected, "secrecy code: rank medium", 3.66, exact(*study, "secrecy_code_a", "fusing"), 2, 4);
  found.claim(Reading::corrected, "two-step at step 200: rank relatively high at least", "infinite (a limit)", two, 4,
              64);
  found.claim(Reading::corrected, "two-step at step 200 less that at step 100", "grows without bound",
              {two.value - exact(*early, "two_step", "differencing").value}, 0.5, 2);
  found.claim(Reading::noted, "contamination against the printed number", 1.23,
              exact(*study, "contamination", "fusing"), 1.1, 1.4);
  found.claim(Reading::noted, "contamination, by errors", 1.23, pooled(*study, "contamination", "fusing"), 1, 2);
  found.claim(Reading::noted, "secrecy code, by errors", 3.66, pooled(*study, "secrecy_code_a", "fusing"), 2, 4);
  found.claim(Reading::noted, "two-step, by errors of steps 161 to 200", "infinite (a limit)",
              pooled(*study, "two_step", "differencing"), 4, 64);
  found.claim(Reading::noted, "two-step for an eavesdropper who takes the window's mean", "infinite (a limit)",
              exact(*study, "two_step", "window_mean"), 4, 64);
  found.panels.push_back(index_panel(laboratory, lanes));
  return found;
}

}  // namespace

std::vector<Item> engine_design_items() {
  return {
      {"004/fig4-4",
       {"Engine: densities of neighbouring messages", "邻居 PLREs 的概率分布函数"},
       "privacy, sections 4.1, 4.5 and 5",
       kId,
       "After correction where the noise measured in messages is the design's within 6 % for each sensor and component "
       "and neighbours are less than 0.6 of it apart.",
       "(4-12) sums one term too many and (4-14) is a matrix inequality. The guarantee is for the message at the "
       "moment of the difference alone: later ones and the whole stream tell more.",
       neighbours},
      {"004/eq4-33",
       {"Engine: stationary gains and weights", "稳态增益与融合权矩阵"},
       "privacy, sections 1.3 and 4.7",
       kId,
       "After correction where all 24 numbers agree to the two digits printed.",
       "(3-8) lacks the inverse on the innovation's covariance and (3-9) has a minus where a plus belongs; with both "
       "mended every printed number comes out. Nothing here is random.",
       printed_numbers},
      {"004/ci",
       {"Engine: confidentiality index and rank by strategy", "各种策略的保密性指数与保密等级"},
       "privacy, sections 1.7, 4.4, 4.6 and 4.7",
       kId,
       "Reproduced where two-step's index is 4 at least with the printed sums; after correction where contamination is "
       "relatively low (1 to 2), the code medium (2 to 4), and two-step 4 at least and growing.",
       "The infinite index is a limit and holds for the differencing eavesdropper only. How often the code's "
       "eavesdropper misses is not given: 0.36 is fitted to the printed 3.66. Contamination's index is larger than "
       "printed, in the same rank.",
       index}};
}

}  // namespace vigil::papers
