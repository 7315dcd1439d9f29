#include <cmath>
#include <optional>

#include "engine/methods/privacy/dp_losses.hpp"
#include "engine/methods/privacy/eavesdroppers.hpp"
#include "engine/methods/privacy/mechanism_params.hpp"
#include "engine/methods/privacy/protection.hpp"
#include "engine/methods/privacy/published_mean.hpp"
#include "engine/random/draws.hpp"

namespace vigil::privacy {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Takes what is published for the state. It does not need to overhear anything.
class Reader final : public Eavesdropper {
 public:
  explicit Reader(VectorXd prior) : estimate_(std::move(prior)) {}
  std::unique_ptr<Eavesdropper> clone() const override { return std::make_unique<Reader>(*this); }
  void see(const PublicTick& /*tick*/, const VectorXd& published) override { estimate_ = published; }
  void listen(const PublicTick& /*tick*/, const MatrixXd& /*messages*/, std::span<const char> /*heard*/) override {}
  const VectorXd& estimate() const override { return estimate_; }

 private:
  VectorXd estimate_;
};

class DpCentre final : public Protection {
 public:
  DpCentre(const Params& params, const Knowledge& knowledge)
      : knowledge_(knowledge),
        model_(fusion_model(knowledge)),
        settings_(read_settings(params, model_)),
        design_(design_dp_fusion(model_, settings_)),
        q_(params.boolean("as_printed") ? design_.q_centre : design_.q_centre_enough),
        draws_(knowledge.seed, "protection.a"),
        a_(model_.states()),
        mean_(model_.states(), settings_.kappa),
        published_(VectorXd::Zero(model_.states())),
        steady_(knowledge.stationary),
        meter_(model_.states(), settings_.epsilon, settings_.delta, dp_centre_losses(design_, settings_, q_)) {
    if (knowledge.stationary) lag_.emplace(model_, design_.filters, design_.nominal, settings_.kappa);
    if (const auto S = state_covariance(model_); S && knowledge.stationary) zero_ = S->trace();
  }
  std::unique_ptr<Protection> clone() const override { return std::make_unique<DpCentre>(*this); }

  void encode(const PublicTick& tick, MatrixXd& /*messages*/) override {
    steady_ = steady_ && (tick.settled || stationary(tick, design_.filters));
  }
  void decode(const PublicTick& tick, const MatrixXd& received, std::span<const char> lost, Decoded& decoded) override {
    for (const char one : lost) steady_ = steady_ && one == 0;
    Protection::decode(tick, received, lost, decoded);
  }
  void release(const PublicTick& tick, const VectorXd& fused) override {
    draws_.normals(tick.k, a_);
    a_ *= std::sqrt(q_);
    published_ = mean_.add(fused) + a_;
    if (lag_) lag_trace_ = lag_->step();
    meter_.add(a_);
  }
  const VectorXd* published() const override { return &published_; }

  std::unique_ptr<Eavesdropper> eavesdropper(const std::string& variant) const override {
    return variant == "fusing" ? std::make_unique<Reader>(model_.x0) : zero_eavesdropper(model_.states());
  }
  double eavesdropper_trace(const PublicTick& /*tick*/, const std::string& variant) const override {
    if (variant == "zero") return zero_;
    return steady_ ? lag_trace_ + static_cast<double>(model_.states()) * q_ : std::numeric_limits<double>::quiet_NaN();
  }

  void declare(SignalScope& scope) override {
    ids_.clear();
    for (const Component& component : knowledge_.plant->state())
      ids_.push_back(scope.add(model_.count(), "published." + component.name, component.unit, SignalKind::scalar));
    meter_.declare(scope);
  }
  void publish(std::span<double> values) const override {
    for (std::size_t c = 0; c < ids_.size(); ++c)
      values[static_cast<std::size_t>(ids_[c])] = published_[static_cast<Eigen::Index>(c)];
    meter_.publish(values);
  }
  std::vector<OwnMetric> metrics() const override { return meter_.metrics(); }

  Json design() const override {
    Json design{{"gamma", design_.gamma},
                {"epsilon", settings_.epsilon},
                {"delta", settings_.delta},
                {"sigma", design_.sigma},
                {"q", q_},
                {"W", matrix_json(design_.nominal.W)},
                {"views", meter_.design(knowledge_.nodes)},
                {"views_design_mu", 1 / design_.gamma}};
    const VectorXd& shift = meter_.views().front().shift;  // of one published mean
    add_releases(design, "fused", *knowledge_.plant, VectorXd::Constant(shift.size(), std::sqrt(q_)), shift);
    add_distance(design, "fused", std::sqrt(q_), shift);
    return design;
  }
  std::vector<std::string> warnings() const override {
    if (knowledge_.stationary) return {};
    return {"the noise is designed for local filters in their stationary law, which this lane does not start in"};
  }

 private:
  static DpSettings read_settings(const Params& params, const FusionModel& model) {
    DpSettings settings = read_dp_settings(params, model.states());
    settings.at_centre = true;
    return settings;
  }

  Knowledge knowledge_;
  FusionModel model_;
  DpSettings settings_;
  DpFusion design_;
  double q_;  ///< variance of each component of the noise
  Draws draws_;
  VectorXd a_;
  PublishedMean mean_;
  VectorXd published_;
  std::optional<MeanTrace> lag_;
  double lag_trace_ = std::numeric_limits<double>::quiet_NaN();
  double zero_ = std::numeric_limits<double>::quiet_NaN();
  bool steady_;  ///< every tick so far was in the filters' stationary law, and nothing was lost
  LossMeter meter_;
  std::vector<int> ids_;
};

const Registration<ProtectionMake> registration({
    "dp_centre",
    {"Differential privacy, noise at the centre", "差分隐私（融合中心加噪）"},
    "seed 004, (3-16)-(3-21); specification (privacy), section 3.2",
    dp_table({{.name = "as_printed",
               .type = ParamType::boolean,
               .fallback = true,
               .meaning = {"Noise as the theorem prints it; false: its variance over kappa squared, which is enough",
                           "噪声按定理原式；false 表示方差除以 κ²（已足够）"}}}),
    [](const Params& params, const Knowledge& knowledge) -> std::unique_ptr<Protection> {
      return std::make_unique<DpCentre>(params, knowledge);
    },
});

}  // namespace
}  // namespace vigil::privacy
