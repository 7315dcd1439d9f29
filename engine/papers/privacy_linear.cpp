/// Seed 004, figures 2-2 to 2-4: the linear robot whose sensors contaminate what they send.
#include <limits>

#include "engine/papers/privacy.hpp"

namespace vigil::papers {
namespace {

const std::string kLane = "lane.contamination.";
constexpr double kAny = std::numeric_limits<double>::infinity();

Scenario robot(const Json& patch = Json::object()) { return preset("privacy-robot-linear", {"contamination"}, patch); }

/// Theorem 2.1 without the test of boundedness, two components.
Json unrestricted() { return protection("contamination", {{"m", 2}, {"bounded_check", false}}); }

/// Slope of the eavesdropper's position on the true one over late ticks of all runs.
Estimate slope(const Records& records) {
  std::vector<double> products, squares;
  for (const Record& record : records) {
    double product = 0, square = 0;
    for (std::size_t k = 81; k <= 100; ++k) {
      const double truth = record.at("truth.position", k);
      product += record.at(kLane + "eve.fusing.estimate.position", k) * truth;
      square += truth * truth;
    }
    products.push_back(product);
    squares.push_back(square);
  }
  return ratio_of(products, squares);
}

Findings tracks(Laboratory& laboratory) {
  const auto printed = laboratory.campaign(robot(unrestricted())), ours = laboratory.campaign(robot());
  const std::vector<std::string> signals{"truth.position", kLane + "fused.estimate.position",
                                         kLane + "eve.fusing.estimate.position"};
  const auto records = laboratory.samples(robot(), signals);
  Findings found;
  found.runs = ours->runs;
  const char* user = "mean squared error of the legitimate user over the last 20 steps";
  const auto error = [](const Study& of) { return of.at("contamination", "mse_legitimate_mean"); };
  found.claim(Reading::printed, user, "on the target (a picture)", error(*printed), 0, 2);
  found.claim(Reading::corrected, user, "on the target (a picture)", error(*ours), 0, 2);
  found.claim(Reading::corrected, "eavesdropper's position as a share of the true one, steps 81 to 100",
              "far off (a picture)", slope(*records), 0.4, 0.6);
  Panel panel{"position, one run", {"t"}, {"position"}, {}};
  const char* names[] = {"target", "legitimate user", "eavesdropper"};
  for (std::size_t i = 0; i < signals.size(); ++i)
    panel.series.push_back(
        series(names[i], records->front().time, records->front().of(signals[i]), i == 1 ? "dashed" : "line"));
  found.panels.push_back(std::move(panel));
  return found;
}

Findings errors(Laboratory& laboratory) {
  const auto printed = laboratory.campaign(robot(unrestricted())), ours = laboratory.campaign(robot());
  Findings found;
  found.runs = ours->runs;
  const auto late = [&](Reading reading, const Study& of, const char* what, const char* metric, const char* node,
                        double low, double high) {
    found.claim(reading, std::string("mean squared error over the last 20 steps, ") + what, "bounded (a picture)",
                of.at("contamination", metric, node), low, high);
  };
  late(Reading::printed, *printed, "fused (DFE)", "mse_legitimate_mean", "", 0, 2);
  late(Reading::corrected, *ours, "fused (DFE)", "mse_legitimate_mean", "", 0.75, 1.15);
  late(Reading::corrected, *ours, "optimal", "mse_optimal_mean", "", 0.36, 0.51);
  late(Reading::corrected, *ours, "compensated local 1", "mse_compensated_mean", "1", 1.4, 3.4);
  late(Reading::corrected, *ours, "compensated local 2", "mse_compensated_mean", "2", 1.6, 3.8);
  const std::vector<std::string> signals{kLane + "1.compensated_square", kLane + "2.compensated_square",
                                         kLane + "fused.square", kLane + "optimal.square"};
  found.panels.push_back(
      errors_panel(*laboratory.samples(robot(), signals),
                   {{"CLE 1", signals[0]}, {"CLE 2", signals[1]}, {"DFE", signals[2]}, {"optimal", signals[3]}},
                   "mean squared errors"));
  return found;
}

/// Late error over early error of the eavesdropper: how it grows.
Estimate growth(const Records& records, const std::string& signal) {
  return ratio_of(of_runs(records, [&](const Record& r) { return over_ticks(r, signal, 81, 100); }),
                  of_runs(records, [&](const Record& r) { return over_ticks(r, signal, 21, 40); }));
}

Findings eavesdroppers(Laboratory& laboratory) {
  const std::string noisy = "lane.complex_noise.eve.fusing.square", hidden = kLane + "eve.fusing.square";
  const auto channel = [&](const char* kind, double power) {
    return laboratory.samples(preset("privacy-robot-linear", {"complex_noise"},
                                     protection("complex_noise", {{"channel", kind}, {"power", power}})),
                              {noisy});
  };
  Findings found;
  Panel panel{"eavesdropper's mean squared error", {"t"}, {"MSE", true}, {}};
  const auto add = [&](const std::string& name, const Records& records, const std::string& signal) {
    const auto curve = mean_curve(records, signal);
    panel.series.push_back(series(name, ticks(curve.size()), curve, "line", 1));
  };
  const auto contaminated = laboratory.samples(robot(), {hidden});
  found.runs = static_cast<std::int64_t>(contaminated->size());
  add("contamination", *contaminated, hidden);
  const char* what = "growth of the error, steps 81-100 over 21-40, artificial noise of power ";
  for (const auto& [kind, reading] : {std::pair{"fading", Reading::printed}, std::pair{"static", Reading::corrected}}) {
    const auto weak = channel(kind, 1), strong = channel(kind, 5.6097);
    const std::string of = std::string(", ") + kind + " channel";
    found.claim(reading, what + ("5.6097" + of), "diverges", growth(*strong, noisy), 8, kAny);
    found.claim(reading, what + ("1" + of), "bounded", growth(*weak, noisy), 0, 4);
    add("power 1" + of, *weak, noisy);
    add("power 5.6097" + of, *strong, noisy);
  }
  found.claim(Reading::corrected, "growth of the error, steps 81-100 over 21-40, contamination", "diverges",
              growth(*contaminated, hidden), 8, kAny);
  found.panels.push_back(std::move(panel));
  return found;
}

const char* const kReason =
    "The compensated recursion (2-30)-(2-33) and its singular covariance had to be corrected, and a set of components "
    "is "
    "admissible only where the user's error stays bounded: Theorem 2.1 asserts it for every choice, which is false (m "
    "= 2, "
    "unrestricted, as the printed reading here: it grows without bound). Sampling time, start and m are not given.";

}  // namespace

std::vector<Item> linear_robot_items() {
  const std::string id = "privacy-robot-linear";
  return {
      {"004/fig2-2",
       {"Linear robot: target, legitimate user and eavesdropper", "线性系统下目标、合法用户以及窃听者的轨迹"},
       "privacy, sections 2.2 to 2.5 and 5",
       id,
       "Reproduced where the user's late error is at most 2 under the unrestricted choice of components; after "
       "correction where it is with admissible sets and the eavesdropper is at 40 to 60 % of the true position.",
       kReason,
       tracks},
      {"004/fig2-3",
       {"Linear robot: compensated local, fused and optimal errors", "线性系统下补偿局部估计、融合估计以及最优的 MSE"},
       "privacy, sections 2.2 to 2.5 and 5",
       id,
       "Reproduced where the fused error is bounded under the unrestricted choice; after correction where optimal, "
       "fused and both compensated errors lie about the exact traces, optimal < fused < compensated.",
       kReason,
       errors},
      {"004/fig2-4",
       {"Linear robot: the eavesdropper's error by mechanism", "线性系统下窃听者的 MSE 对比"},
       "privacy, section 2.8",
       id,
       "Reproduced where artificial noise of power 5.6097 makes the eavesdropper diverge (eightfold) and power 1 does "
       "not (fourfold at most) on the fading channel; after correction where so on a static channel.",
       "With any chance of success the predicting eavesdropper is bounded; only a static channel, on which every "
       "packet is lost, diverges, as the third power of time and not exponentially as the text says: the plant's "
       "eigenvalues lie on the unit circle. The model of the artificial noise is our reconstruction.",
       eavesdroppers}};
}

}  // namespace vigil::papers
