/// White Gaussian noise on every message, for any lane whose nodes talk. Nobody takes it off again.
#include <cmath>

#include "engine/methods/privacy/eavesdroppers.hpp"
#include "engine/methods/privacy/protection.hpp"
#include "engine/random/draws.hpp"

namespace vigil::privacy {
namespace {

class GaussianNoise final : public Protection {
 public:
  GaussianNoise(const Params& params, const Knowledge& knowledge)
      : variance_(params.real("variance")), knowledge_(knowledge), draws_(knowledge.seed, "protection.noise") {}

  std::unique_ptr<Protection> clone() const override { return std::make_unique<GaussianNoise>(*this); }
  bool needs_centre() const override { return false; }

  void encode(const PublicTick& tick, Eigen::MatrixXd& messages) override {
    const double deviation = std::sqrt(variance_);
    for (Eigen::Index entry = 0; entry < messages.size(); ++entry)
      messages.data()[entry] += deviation * draws_.normal(tick.k, static_cast<std::uint32_t>(entry));
  }

  Eigen::MatrixXd noise() const override {
    const auto stacked = static_cast<Eigen::Index>(knowledge_.plant->states() * knowledge_.sensors.size());
    return variance_ * Eigen::MatrixXd::Identity(stacked, stacked);
  }

  std::unique_ptr<Eavesdropper> eavesdropper(const std::string& variant) const override {
    if (variant == "zero") return zero_eavesdropper(knowledge_.plant->states());
    return fusing_eavesdropper(knowledge_);
  }

  double eavesdropper_trace(const PublicTick& tick, const std::string& variant) const override {
    if (variant != "fusing") return Protection::eavesdropper_trace(tick, variant);
    return tick.nominal.P.trace() + variance_ * tick.nominal.W.squaredNorm();  // W (P + q I) W'
  }

  Json design() const override { return {{"variance", variance_}}; }

 private:
  double variance_;
  Knowledge knowledge_;
  Draws draws_;
};

const Registration<ProtectionMake> registration({
    "gaussian_noise",
    {"White noise on every message", "报文加白噪声"},
    "specification of seed 004, section 1.6",
    ParamTable({
        {.name = "variance",
         .fallback = 0.01,
         .minimum = 0,
         .symbol = "q",
         .meaning = {"Variance of the noise on every entry", "各分量噪声方差"}},
    }),
    [](const Params& params, const Knowledge& knowledge) -> std::unique_ptr<Protection> {
      return std::make_unique<GaussianNoise>(params, knowledge);
    },
});

}  // namespace
}  // namespace vigil::privacy
