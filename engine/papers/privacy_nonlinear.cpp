/// Seed 004, figures 2-5 to 2-7: the robot among landmarks.
#include "engine/papers/privacy.hpp"

namespace vigil::papers {
namespace {

const std::string kLane = "lane.contamination.";
const std::vector<std::string> kSquares{kLane + "1.compensated_square", kLane + "2.compensated_square",
                                        kLane + "fused.square", kLane + "optimal.square", kLane + "eve.fusing.square"};

Scenario robot(bool printed) {
  const Json patch = {{"lanes", {{"contamination", {{"params", {{"printed_jacobian", printed}}}}}}}};
  return preset("privacy-robot-nonlinear", {"contamination"}, patch);
}

std::shared_ptr<const Records> squares(Laboratory& laboratory, bool printed) {
  return laboratory.samples(robot(printed), kSquares);
}

std::vector<double> late(const Records& records, const std::string& what) {
  return of_runs(records, [&](const Record& r) { return over_ticks(r, kLane + what, 11, 100); });
}

Findings tracks(Laboratory& laboratory) {
  const auto printed = squares(laboratory, true), ours = squares(laboratory, false);
  Findings found;
  found.runs = static_cast<std::int64_t>(ours->size());
  const char* user = "mean squared error of the legitimate user, steps 11 to 100";
  found.claim(Reading::printed, user, "on the target (a picture)", mean_of(late(*printed, "fused.square")), 0, 0.3);
  found.claim(Reading::corrected, user, "on the target (a picture)", mean_of(late(*ours, "fused.square")), 0, 0.3);
  found.claim(Reading::corrected, "mean squared error of the eavesdropper, steps 11 to 100", "far off (a picture)",
              mean_of(late(*ours, "eve.fusing.square")), 400, 1000);
  std::vector<std::string> signals;
  for (const char* who : {"truth.", "lane.contamination.fused.estimate.", "lane.contamination.eve.fusing.estimate."}) {
    signals.push_back(std::string(who) + "sx");
    signals.push_back(std::string(who) + "sy");
  }
  const auto one = laboratory.samples(robot(false), signals, 1);
  Panel panel{"path, one run", {"x"}, {"y"}, {}};
  const char* names[] = {"target", "legitimate user", "eavesdropper"};
  for (std::size_t i = 0; i < 3; ++i)
    panel.series.push_back(series(names[i], one->front().of(signals[2 * i]), one->front().of(signals[2 * i + 1]),
                                  i == 1 ? "dashed" : "line"));
  found.panels.push_back(std::move(panel));
  return found;
}

Findings errors(Laboratory& laboratory) {
  const auto printed = squares(laboratory, true), ours = squares(laboratory, false);
  Findings found;
  found.runs = static_cast<std::int64_t>(ours->size());
  const auto claim = [&](Reading reading, const Records& of, const char* name, const char* what, double low,
                         double high) {
    found.claim(reading, std::string("mean squared error, steps 11 to 100, ") + name, "bounded (a picture)",
                mean_of(late(of, what)), low, high);
  };
  claim(Reading::printed, *printed, "fused (DFE)", "fused.square", 0, 0.3);
  claim(Reading::printed, *printed, "optimal", "optimal.square", 0, 0.1);
  claim(Reading::corrected, *ours, "fused (DFE)", "fused.square", 0.08, 0.2);
  claim(Reading::corrected, *ours, "optimal", "optimal.square", 0.035, 0.05);
  claim(Reading::corrected, *ours, "compensated local 1", "1.compensated_square", 0.1, 0.25);
  claim(Reading::corrected, *ours, "compensated local 2", "2.compensated_square", 0.1, 0.25);
  found.panels.push_back(errors_panel(
      *ours, {{"CLE 1", kSquares[0]}, {"CLE 2", kSquares[1]}, {"DFE", kSquares[2]}, {"optimal", kSquares[3]}},
      "mean squared errors"));
  return found;
}

Findings eavesdropper(Laboratory& laboratory) {
  const auto printed = squares(laboratory, true), ours = squares(laboratory, false);
  Findings found;
  found.runs = static_cast<std::int64_t>(ours->size());
  const char* what = "eavesdropper's mean squared error over the user's, steps 11 to 100";
  const auto ratio = [](const Records& of) {
    return ratio_of(late(of, "eve.fusing.square"), late(of, "fused.square"));
  };
  found.claim(Reading::printed, what, "thousands", ratio(*printed), 1000, 10000);
  found.claim(Reading::corrected, what, "thousands", ratio(*ours), 1000, 10000);
  found.panels.push_back(errors_panel(*ours, {{"eavesdropper", kSquares[4]}, {"legitimate user", kSquares[2]}},
                                      "eavesdropper's mean squared error"));
  return found;
}

const char* const kReason =
    "(2-52) divides the bearing's derivatives by r where it must be r squared: as printed even the uncontaminated "
    "error is "
    "about 17 times larger and the fused estimate useless. (2-4)-(2-6) propagate and linearise at the wrong points. "
    "Speeds, "
    "landmarks, noise and m are not given.";

}  // namespace

std::vector<Item> nonlinear_robot_items() {
  const std::string id = "privacy-robot-nonlinear", spec = "privacy, sections 1.3, 2.6 and 5";
  return {
      {"004/fig2-5",
       {"Robot among landmarks: target, legitimate user and eavesdropper",
        "非线性系统下目标、合法用户以及窃听者的轨迹"},
       spec,
       id,
       "Reproduced where the user's mean squared error is at most 0.3 with the printed derivatives; after correction "
       "where it is with the right ones and the eavesdropper's is 400 to 1000.",
       kReason,
       tracks},
      {"004/fig2-6",
       {"Robot among landmarks: compensated local, fused and optimal errors",
        "非线性系统下补偿局部估计、融合估计以及最优的 MSE"},
       spec,
       id,
       "Reproduced where the fused error is at most 0.3 and the optimal one at most 0.1 with the printed derivatives; "
       "after correction where all four lie about the specification's values, optimal below fused.",
       kReason,
       errors},
      {"004/fig2-7",
       {"Robot among landmarks: the eavesdropper's error", "非线性系统下窃听者的 MSE"},
       spec,
       id,
       "Reproduced where the eavesdropper's mean squared error is 1000 to 10000 times the user's with the printed "
       "derivatives; after correction where it is with the right ones.",
       kReason,
       eavesdropper}};
}

}  // namespace vigil::papers
