#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/methods/privacy/dp_losses.hpp"
#include "engine/methods/privacy/dp_surfaces.hpp"
#include "engine/methods/privacy/eavesdroppers.hpp"
#include "engine/methods/privacy/mechanism_params.hpp"
#include "engine/methods/privacy/protection.hpp"
#include "engine/methods/privacy/published_mean.hpp"
#include "engine/random/draws.hpp"

namespace vigil::privacy {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kIllConditioned = 1e4;  // of W_i; 1e10 is refused

DpSettings read_settings(const Params& params, const FusionModel& model) {
  DpSettings settings = read_dp_settings(params, model.states());
  if (params.given("shares")) {
    const VectorXd shares = params.vector("shares");
    settings.shares.assign(shares.begin(), shares.end());
  }
  return settings;
}

class DpSensors final : public Protection {
 public:
  DpSensors(const Params& params, const Knowledge& knowledge)
      : knowledge_(knowledge),
        model_(fusion_model(knowledge)),
        settings_(read_settings(params, model_)),
        design_(design_dp_fusion(model_, settings_)),
        N_(design_.Pc - design_.filters.P),
        draws_(knowledge.seed, "protection.xi"),
        xi_(model_.stacked()),
        taken_(model_.states(), model_.count()),
        fused_(model_.x0),
        ahead_(model_.states()),
        mean_(model_.states(), settings_.kappa),
        published_(VectorXd::Zero(model_.states())),
        meter_(model_.stacked(), settings_.epsilon, settings_.delta, dp_sensor_losses(design_, settings_)) {
    if (const auto S = state_covariance(model_); S && knowledge.stationary) zero_ = S->trace();
  }
  std::unique_ptr<Protection> clone() const override { return std::make_unique<DpSensors>(*this); }

  void encode(const PublicTick& tick, MatrixXd& messages) override {
    draws_.normals(tick.k, xi_);
    const auto n = messages.rows();
    for (std::size_t i = 0; i < design_.q.size(); ++i) {
      const auto column = static_cast<Eigen::Index>(i);
      auto xi = xi_.segment(column * n, n);
      xi *= std::sqrt(design_.q[i]);
      messages.col(column).noalias() += design_.G[i] * xi;
    }
    meter_.add(xi_);
  }

  void decode(const PublicTick& tick, const MatrixXd& received, std::span<const char> lost, Decoded& decoded) override {
    Protection::decode(tick, received, lost, decoded);
    publish_fused(tick, received, lost);
  }
  MatrixXd noise() const override { return N_; }

  std::unique_ptr<Eavesdropper> eavesdropper(const std::string& variant) const override {
    return variant == "fusing" ? fusing_eavesdropper(knowledge_) : zero_eavesdropper(model_.states());
  }
  double eavesdropper_trace(const PublicTick& tick, const std::string& variant) const override {
    if (variant == "zero") return zero_;
    const MatrixXd& W = tick.nominal.W;
    return (W * (tick.P + N_)).cwiseProduct(W).sum();
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
    Json conditions = Json::array();
    for (const double condition : design_.condition)
      conditions.push_back(std::isfinite(condition) ? Json(condition) : Json(nullptr));
    Json design{{"gamma", design_.gamma},
                {"epsilon", settings_.epsilon},
                {"delta", settings_.delta},
                {"sigma", design_.sigma},
                {"q_tot", design_.q_total},
                {"q", design_.q},
                {"condition", conditions},
                {"W", matrix_json(design_.nominal.W)},
                {"Wc", matrix_json(design_.compensated.W)},
                {"views", meter_.design(knowledge_.nodes)},
                {"views_design_mu", 1 / design_.gamma}};
    const double std = std::sqrt(design_.q_total / settings_.kappa);
    const VectorXd& shift = meter_.views().front().shift;  // of one published mean
    add_releases(design, "fused", *knowledge_.plant, VectorXd::Constant(shift.size(), std), shift);
    add_distance(design, "fused", std, shift);
    if (design_.q_total > 0) design["surfaces"] = dp_surfaces(design_, settings_);
    return design;
  }

  std::vector<std::string> warnings() const override {
    std::vector<std::string> warnings;
    for (std::size_t i = 0; i < design_.q.size(); ++i) {
      if (design_.q[i] > 0 && design_.condition[i] >= kIllConditioned)
        warnings.push_back(fmt::format("the weights of sensor {} have condition {:.3g}: its noise is amplified as much",
                                       knowledge_.nodes[i], design_.condition[i]));
    }
    if (!knowledge_.stationary)
      warnings.emplace_back(
          "the noises are designed for local filters in their stationary law, which this lane does "
          "not start in");
    return warnings;
  }

 private:
  /// The public fusion with the nominal weights; it predicts what it did not get.
  void publish_fused(const PublicTick& tick, const MatrixXd& received, std::span<const char> lost) {
    if (tick.k > 0)
      ahead_.noalias() = model_.A * fused_;
    else
      ahead_ = fused_;
    taken_ = received;
    for (std::size_t i = 0; i < lost.size(); ++i) {
      if (lost[i]) taken_.col(static_cast<Eigen::Index>(i)) = ahead_;
    }
    fused_.noalias() = design_.nominal.W * taken_.reshaped();
    published_ = mean_.add(fused_);
  }

  Knowledge knowledge_;
  FusionModel model_;
  DpSettings settings_;
  DpFusion design_;
  MatrixXd N_;  ///< of what the sensors add
  double zero_ = std::numeric_limits<double>::quiet_NaN();
  Draws draws_;
  VectorXd xi_;
  MatrixXd taken_;
  VectorXd fused_, ahead_;
  PublishedMean mean_;
  VectorXd published_;
  LossMeter meter_;
  std::vector<int> ids_;
};

const Registration<ProtectionMake> registration({
    "dp_sensors",
    {"Differential privacy, noise at the sensors", "差分隐私（传感器端加噪）"},
    "seed 004, (3-23)-(3-33); specification (privacy), sections 3.2 and 3.3",
    dp_table({{.name = "shares",
               .type = ParamType::vector,
               .nullable = true,
               .symbol = "s_i",
               .meaning = {"How much of the noise each sensor adds, of sum 1; null: all alike",
                           "各传感器承担的噪声份额，总和为 1；null 表示均分"}}}),
    [](const Params& params, const Knowledge& knowledge) -> std::unique_ptr<Protection> {
      return std::make_unique<DpSensors>(params, knowledge);
    },
});

}  // namespace
}  // namespace vigil::privacy
