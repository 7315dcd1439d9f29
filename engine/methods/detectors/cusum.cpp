/// The cumulative sum of normalised squares: finds what is small and lasts. Page (1954).
#include <cmath>

#include "engine/methods/detectors/detector.hpp"

namespace vigil {
namespace {

class Cusum final : public Detector {
 public:
  explicit Cusum(const Params& params) { take(params); }

  std::unique_ptr<Detector> clone() const override { return std::make_unique<Cusum>(*this); }

  // C <- max(0, C + (r' S^-1 r - m) / sqrt(2 m) - drift): without attack the middle term has mean 0 and variance 1.
  Detection judge(std::int64_t /*k*/, const Eigen::Ref<const Eigen::VectorXd>& innovation,
                  const Eigen::Ref<const Eigen::MatrixXd>& covariance) override {
    const double square = square_(innovation, covariance);
    if (!std::isfinite(square)) return hold();
    const auto channels = static_cast<double>(innovation.size());
    if (restarts_ && sum_ > threshold_) sum_ = 0;
    sum_ = std::max(0.0, sum_ + (square - channels) / std::sqrt(2 * channels) - drift_);
    return {sum_, threshold_, true, sum_ > threshold_};
  }
  void retune(const Params& params) override { take(params); }

 private:
  void take(const Params& params) {
    drift_ = params.real("drift");
    threshold_ = params.real("threshold");
    restarts_ = params.boolean("restart");
  }

  double drift_ = 0, threshold_ = 0, sum_ = 0;
  bool restarts_ = true;
  NormalisedSquare square_;
};

const Registration<DetectorMake> registration({
    "cusum",
    {"Cumulative sum", "累积和检测"},
    "textbook",
    ParamTable({
        {.name = "drift",
         .fallback = 0.5,
         .minimum = 0,
         .maximum = 1e6,
         .live = true,
         .symbol = "ν",
         .meaning = {"What is taken off at every tick, in standard deviations", "每步漂移量（标准差）"}},
        {.name = "threshold",
         .fallback = 10,
         .minimum = 0,
         .maximum = 1e9,
         .live = true,
         .symbol = "h",
         .meaning = {"Sum above which it alarms", "报警阈值"}},
        {.name = "restart",
         .type = ParamType::boolean,
         .fallback = true,
         .live = true,
         .meaning = {"Begins again from zero after an alarm", "报警后归零"}},
    }),
    [](const Params& params) -> std::unique_ptr<Detector> { return std::make_unique<Cusum>(params); },
});

}  // namespace
}  // namespace vigil
