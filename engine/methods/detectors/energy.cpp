/// The energy of the innovation against a threshold that moves, or against one that was learned or given. Seed 003,
/// (25)-(28), on any lane's innovation.
#include <cmath>

#include "engine/methods/detectors/detector.hpp"
#include "engine/methods/replay/detector.hpp"

namespace vigil {
namespace {

/// What one of the two kinds makes of its parameters.
struct EnergyRule {
  replay::DetectorSettings settings;
  double level = std::numeric_limits<double>::quiet_NaN();  ///< NaN: the detector's own threshold
};
using ReadRule = EnergyRule (*)(const Params& params);

class Energy final : public Detector {
 public:
  Energy(const Params& params, ReadRule read)
      : read_(read), detector_(read(params).settings), level_(read(params).level) {}

  std::unique_ptr<Detector> clone() const override { return std::make_unique<Energy>(*this); }

  Detection judge(std::int64_t k, const Eigen::Ref<const Eigen::VectorXd>& innovation,
                  const Eigen::Ref<const Eigen::MatrixXd>& /*covariance*/) override {
    return say(detector_.judge(k, innovation), true);
  }
  Detection hold() override { return say(detector_.hold(), false); }
  int tail() const override { return detector_.settings().window - 1; }
  void retune(const Params& params) override {
    const EnergyRule rule = read_(params);
    detector_.retune(rule.settings);
    level_ = rule.level;
  }

 private:
  Detection say(const replay::Verdict& verdict, bool judged) const {
    Detection detection;
    if (verdict.has_statistic) detection.statistic = verdict.statistic;
    if (std::isfinite(level_)) {
      detection.threshold = level_;
      detection.alarm = verdict.has_statistic && verdict.statistic > level_;
    } else {
      if (verdict.has_threshold) detection.threshold = verdict.threshold;
      detection.alarm = verdict.flag;
    }
    detection.judged = judged && verdict.has_statistic;
    return detection;
  }

  ReadRule read_;
  replay::EnergyDetector detector_;
  double level_;
};

EnergyRule dynamic_rule(const Params& params) {
  EnergyRule rule;
  rule.settings.window = params.integer("window");
  rule.settings.threshold =
      params.text("threshold") == "printed" ? replay::Threshold::printed : replay::Threshold::frozen;
  rule.settings.tau = params.integer("tau");
  rule.settings.eta = params.real("eta");
  rule.settings.iota = params.real("iota");
  return rule;
}

EnergyRule fixed_rule(const Params& params) {
  EnergyRule rule;
  rule.settings.window = params.integer("window");
  rule.settings.threshold = replay::Threshold::fixed_square;
  if (params.given("level")) rule.level = params.real("level");
  return rule;
}

Param window() {
  return {.name = "window",
          .type = ParamType::integer,
          .fallback = 5,
          .minimum = 1,
          .maximum = 1000,
          .symbol = "t",
          .meaning = {"Innovations in the statistic", "统计量的新息窗口"}};
}

const Registration<DetectorMake> dynamic({
    "dynamic",
    {"Innovation energy, threshold that moves", "新息能量与动态阈值"},
    "seed 003, (25)-(28)",
    ParamTable({
        window(),
        {.name = "threshold",
         .type = ParamType::text,
         .fallback = "frozen",
         .choices = {"printed", "frozen"},
         .symbol = "θ",
         .meaning = {"As printed, or held while flagged", "如原文，或报警时冻结"}},
        {.name = "tau",
         .type = ParamType::integer,
         .fallback = 20,
         .minimum = 2,
         .maximum = 10000,
         .symbol = "τ",
         .meaning = {"Statistics in the threshold's window", "阈值窗口长度"}},
        {.name = "eta",
         .fallback = 3,
         .minimum = 0,
         .maximum = 1e6,
         .live = true,
         .symbol = "η",
         .meaning = {"Standard deviations above the mean", "均值以上的标准差倍数"}},
        {.name = "iota",
         .fallback = 0,
         .minimum = 0,
         .maximum = 1e9,
         .live = true,
         .symbol = "ι",
         .meaning = {"Dead band of the threshold", "阈值死区"}},
    }),
    [](const Params& params) -> std::unique_ptr<Detector> { return std::make_unique<Energy>(params, dynamic_rule); },
});

const Registration<DetectorMake> fixed({
    "fixed",
    {"Innovation energy, fixed threshold", "新息能量与固定阈值"},
    "seed 003, section 5, fixed thresholds",
    ParamTable({
        window(),
        {.name = "level",
         .fallback = nullptr,
         .minimum = 0,
         .nullable = true,
         .live = true,
         .symbol = "θ",
         .meaning = {"Threshold; none: the largest squared norm of ticks 3 to 49",
                     "阈值；无：第 3 至 49 步的最大范数平方"}},
    }),
    [](const Params& params) -> std::unique_ptr<Detector> { return std::make_unique<Energy>(params, fixed_rule); },
});

}  // namespace
}  // namespace vigil
