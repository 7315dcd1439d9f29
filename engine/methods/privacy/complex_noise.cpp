/// The protection `complex_noise`: artificial noise that several antennas send into the null space of the legitimate
/// channel (after Goel and Negi), so that an eavesdropper decodes a message only now and then. Specification (privacy),
/// section 2.8.
#include <algorithm>
#include <cmath>
#include <complex>

#include "engine/methods/privacy/eavesdroppers.hpp"
#include "engine/methods/privacy/protection.hpp"
#include "engine/methods/privacy/start.hpp"
#include "engine/random/draws.hpp"

namespace vigil::privacy {
namespace {

using Complex = std::complex<double>;

class ComplexNoise final : public Protection {
 public:
  ComplexNoise(const Params& params, const Knowledge& knowledge)
      : knowledge_(knowledge),
        antennas_(params.integer("na")),
        ps_(params.real("ps")),
        power_(params.real("power")),
        tau_(params.real("tau")),
        s0_(params.real("s0")),
        fading_(params.text("channel") == "fading"),
        draws_(knowledge.seed, "protection.channel"),
        moment_(knowledge),
        gains_(4 * antennas_ * static_cast<Eigen::Index>(knowledge.sensors.size())),
        audible_(knowledge.sensors.size()) {}

  std::unique_ptr<Protection> clone() const override { return std::make_unique<ComplexNoise>(*this); }

  /// The estimates go as they are: the legitimate user never sees the noise.
  void encode(const PublicTick& tick, Eigen::MatrixXd& /*messages*/) override {
    if (tick.k > 0) moment_.step(tick.input);
    if (fading_) draws_.normals(tick.k, gains_);
    for (std::size_t i = 0; i < audible_.size(); ++i)
      audible_[i] = fading_ ? faded(static_cast<Eigen::Index>(i)) : ps_ / (power_ + s0_) >= tau_;
  }

  std::vector<std::string> eavesdroppers() const override { return {"fusing", "zero"}; }
  std::unique_ptr<Eavesdropper> eavesdropper(const std::string& variant) const override {
    return variant == "zero" ? zero_eavesdropper(knowledge_.plant->states()) : fusing_eavesdropper(knowledge_);
  }
  bool audible(int sensor) const override { return audible_[static_cast<std::size_t>(sensor)] != 0; }
  double eavesdropper_trace(const PublicTick& tick, const std::string& variant) const override {
    if (variant == "zero" && moment_.known()) return moment_.second().trace();
    return Protection::eavesdropper_trace(tick, variant);
  }

  Json design() const override {
    return {{"success_probability", success()},
            {"extra_energy", static_cast<double>(audible_.size()) * (antennas_ - 1) * power_}};
  }

 private:
  double success() const {
    if (!fading_) return ps_ / (power_ + s0_) >= tau_ ? 1 : 0;
    return std::exp(-tau_ * s0_ / ps_) / std::pow(1 + tau_ * power_ / ps_, antennas_ - 1);
  }

  /// Whether the eavesdropper's channel g carries enough of what is aimed along the legitimate channel h. The noise
  /// fills the rest of the space: what of it arrives has the power of the rest of g.
  bool faded(Eigen::Index sensor) const {
    const double* at = gains_.data() + 4 * antennas_ * sensor;
    const double half = std::sqrt(0.5);  // of each part of a CN(0, 1)
    double own = 0, all = 0;
    Complex along = 0;
    for (int a = 0; a < antennas_; ++a, at += 4) {
      const Complex h(half * at[0], half * at[1]), g(half * at[2], half * at[3]);
      own += std::norm(h);
      all += std::norm(g);
      along += g * std::conj(h);
    }
    const double aimed = std::norm(along) / own, rest = std::max(all - aimed, 0.0);
    return ps_ * aimed >= tau_ * (power_ * rest + s0_);
  }

  Knowledge knowledge_;
  int antennas_;
  double ps_, power_, tau_, s0_;
  bool fading_;
  Draws draws_;
  StateMoment moment_;
  Eigen::VectorXd gains_;  ///< parts of h and g of every antenna of every sensor, each N(0, 1)
  std::vector<char> audible_;
};

const Registration<ProtectionMake> registration({
    "complex_noise",
    {"Artificial noise on the channel", "信道人工噪声"},
    "after Goel and Negi; specification (privacy), section 2.8",
    ParamTable({
        {.name = "na",
         .type = ParamType::integer,
         .fallback = 2,
         .minimum = 1,
         .maximum = 64,
         .meaning = {"Antennas of a sensor", "每个传感器的天线数"}},
        {.name = "ps",
         .fallback = 1.0,
         .minimum = 0,
         .maximum = 1e12,
         .exclusive_minimum = true,
         .meaning = {"Power of the message", "信号功率"}},
        {.name = "power",
         .fallback = 1.0,
         .minimum = 0,
         .maximum = 1e12,
         .meaning = {"Power of the noise", "人工噪声功率"}},
        {.name = "tau",
         .fallback = 0.5,
         .minimum = 0,
         .maximum = 1e12,
         .symbol = "τ",
         .meaning = {"Ratio of signal to noise from which on a message is decoded", "可解码的信噪比门限"}},
        {.name = "s0",
         .fallback = 0.1,
         .minimum = 0,
         .maximum = 1e12,
         .exclusive_minimum = true,
         .meaning = {"Power of the eavesdropper's own noise", "窃听者接收噪声功率"}},
        {.name = "channel",
         .type = ParamType::text,
         .fallback = "fading",
         .choices = {"fading", "static"},
         .meaning = {"Gains drawn anew for every message, or all 1", "每条报文独立抽取的信道增益，或恒为 1"}},
    }),
    [](const Params& params, const Knowledge& knowledge) -> std::unique_ptr<Protection> {
      return std::make_unique<ComplexNoise>(params, knowledge);
    },
});

}  // namespace
}  // namespace vigil::privacy
