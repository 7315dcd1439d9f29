/// The chi-square test of innovations over a window: textbook (Mehra and Peschon, 1971).
#include "engine/linalg/chi_square.hpp"

#include <cmath>
#include <vector>

#include "engine/methods/detectors/detector.hpp"

namespace vigil {
namespace {

class ChiSquare final : public Detector {
 public:
  explicit ChiSquare(const Params& params)
      : confidence_(1 - params.real("alpha")), squares_(static_cast<std::size_t>(params.integer("window")), 0) {}

  std::unique_ptr<Detector> clone() const override { return std::make_unique<ChiSquare>(*this); }

  Detection judge(std::int64_t /*k*/, const Eigen::Ref<const Eigen::VectorXd>& innovation,
                  const Eigen::Ref<const Eigen::MatrixXd>& covariance) override {
    const double square = square_(innovation, covariance);
    if (!std::isfinite(square)) return {};
    squares_[next_] = square;
    next_ = (next_ + 1) % squares_.size();
    if (count_ < squares_.size()) ++count_;
    if (innovation.size() != channels_) {
      channels_ = innovation.size();
      threshold_ =
          chi_square_quantile(confidence_, static_cast<double>(channels_) * static_cast<double>(squares_.size()));
    }
    if (count_ < squares_.size()) return {};
    double sum = 0;
    for (const double each : squares_) sum += each;
    return {sum, threshold_, true, sum > threshold_};
  }
  int tail() const override { return static_cast<int>(squares_.size()) - 1; }
  void retune(const Params& params) override {
    confidence_ = 1 - params.real("alpha");
    channels_ = -1;  // the threshold is found anew with the next innovation
  }

 private:
  double confidence_, threshold_ = 0;
  std::vector<double> squares_;  ///< of the last innovations, a ring
  std::size_t next_ = 0, count_ = 0;
  Eigen::Index channels_ = -1;
  NormalisedSquare square_;
};

const Registration<DetectorMake> registration({
    "chi_square",
    {"Chi-square test of the innovation", "新息卡方检验"},
    "textbook",
    ParamTable({
        {.name = "alpha",
         .fallback = 0.01,
         .minimum = 0,
         .maximum = 1,
         .exclusive_minimum = true,
         .exclusive_maximum = true,
         .live = true,
         .symbol = "α",
         .meaning = {"Probability of a false alarm in a tick", "每步虚警概率"}},
        {.name = "window",
         .type = ParamType::integer,
         .fallback = 1,
         .minimum = 1,
         .maximum = 1000,
         .meaning = {"Innovations in the statistic", "统计量的新息个数"}},
    }),
    [](const Params& params) -> std::unique_ptr<Detector> { return std::make_unique<ChiSquare>(params); },
});

}  // namespace
}  // namespace vigil
