#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/methods/privacy/eavesdroppers.hpp"
#include "engine/methods/privacy/loss_meter.hpp"
#include "engine/methods/privacy/mechanism_params.hpp"
#include "engine/methods/privacy/protection.hpp"
#include "engine/methods/privacy/two_step.hpp"
#include "engine/methods/privacy/two_step_eavesdroppers.hpp"
#include "engine/random/draws.hpp"

namespace vigil::privacy {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kNoLeak = 1e-12;  // of the fused covariance

TwoStepSettings read_settings(const Params& params, const FusionModel& model) {
  TwoStepSettings settings{.epsilon = params.real("epsilon"),
                           .delta = params.real("delta"),
                           .zeta = params.real("zeta"),
                           .window = params.integer("tq"),
                           .q_alpha = params.real("q_alpha"),
                           .H = read_adjacent(params, model.states()),
                           .Rg = {},
                           .q_xi = {}};
  if (params.given("Rg")) {
    const MatrixXd Rg = square_matrix(params.values()["Rg"], model.states(), "/Rg");
    settings.Rg.assign(static_cast<std::size_t>(model.count()), Rg);
  }
  if (params.given("q_xi")) {
    const VectorXd q = params.vector("q_xi");
    settings.q_xi.assign(q.begin(), q.end());
  }
  return settings;
}

std::vector<LossView> loss_views(const TwoStep& design, const TwoStepSettings& settings) {
  const auto n = static_cast<int>(design.nominal.P.rows()), size = static_cast<int>(design.Pp.rows());
  std::vector<LossView> all;
  for (int i = 0; i < size / n; ++i) {
    const TwoStepViews views = two_step_views(design, settings, static_cast<std::size_t>(i));
    const auto add = [&](const PrivacyLoss& loss, const char* name) {
      all.push_back(view_of(loss, name, i, size, i * n, n));
    };
    add(views.single, "single");
    add(views.single_worst, "single_worst");
    add(views.difference, "difference");
    MatrixXd& weights = all.back().weights;  // of the newest noise less the one before
    weights.conservativeResize(Eigen::NoChange, 2);
    weights.col(1) = -weights.col(0);
    add(views.prefix, "prefix");
    add(views.stream, "stream");
  }
  // Until the window is full its terms are the first one repeated, and the first message has no null-space noise.
  for (LossView& view : all) view.first = std::max(settings.window - 1, 1) + view.weights.cols() - 1;
  return all;
}

class TwoStepProtection final : public Protection {
 public:
  TwoStepProtection(const Params& params, const Knowledge& knowledge)
      : knowledge_(knowledge),
        model_(fusion_model(knowledge)),
        settings_(read_settings(params, model_)),
        design_(design_two_step(model_, settings_)),
        N_(design_.Pp - design_.filters.P),
        root_alpha_(std::sqrt(settings_.q_alpha)),
        xi_draws_(knowledge.seed, "protection.xi"),
        alpha_draws_(knowledge.seed, "protection.alpha"),
        printed_(params.text("sum") == "printed"),
        sender_(settings_.window, printed_),
        noise_sender_(settings_.window),
        receiver_(design_.compensated.W, settings_.window),
        steady_(knowledge.stationary),
        meter_(model_.stacked(), settings_.epsilon, settings_.delta, loss_views(design_, settings_)) {
    std::vector<MatrixXd> gains;
    for (std::size_t i = 0; i < design_.Rg.size(); ++i) gains.push_back(std::sqrt(design_.q_xi[i]) * design_.Rg[i]);
    gain_ = block_diagonal(gains);
    xi_.resize(model_.stacked());
    alpha_ = eta_ = hidden_ = xp_ = message_ = xi_;
    guess_ = model_.x0;
    if (knowledge.stationary) window_mean_ = window_mean_trace(model_, design_, settings_);
    if (const auto S = state_covariance(model_); S && knowledge.stationary) zero_ = S->trace();
  }
  std::unique_ptr<Protection> clone() const override { return std::make_unique<TwoStepProtection>(*this); }

  void encode(const PublicTick& tick, MatrixXd& messages) override {
    steady_ = steady_ && (tick.settled || stationary(tick, design_.filters));
    xi_draws_.normals(tick.k, xi_);
    alpha_draws_.normals(tick.k, alpha_);
    eta_.noalias() = gain_ * xi_;
    alpha_ *= root_alpha_;
    hidden_.noalias() = design_.Pi * alpha_;
    xp_ = messages.reshaped() + eta_;
    messages.reshaped() = sender_.send(xp_, hidden_);
    if (!printed_) meter_.add(noise_sender_.send(eta_, hidden_));
  }

  void decode(const PublicTick& tick, const MatrixXd& received, std::span<const char> lost, Decoded& decoded) override {
    message_ = received.reshaped();
    const bool gap = std::any_of(lost.begin(), lost.end(), [](char one) { return one != 0; });
    if (gap || !receiver_.in_step()) {
      gaps_ = true;
      if (tick.k > 0) guess_.noalias() = model_.A * receiver_.x();
      decoded.mean = gap ? receiver_.miss(guess_) : receiver_.resume(message_, guess_);
    } else {
      decoded.mean = receiver_.receive(message_);
    }
    decoded.fused = true;
    if (gaps_ || astray(tick))
      decoded.P.resize(0, 0);
    else if (!tick.settled || decoded.P.size() == 0)
      decoded.P = design_.compensated.W * (tick.P + N_) * design_.compensated.W.transpose();
  }

  std::vector<std::string> eavesdroppers() const override { return {"differencing", "window_mean", "fusing", "zero"}; }
  std::unique_ptr<Eavesdropper> eavesdropper(const std::string& variant) const override {
    if (variant == "differencing") return differencing_eavesdropper(model_, settings_.window);
    if (variant == "window_mean") return window_mean_eavesdropper(model_, settings_.window);
    if (variant == "fusing") return fusing_eavesdropper(knowledge_);
    return zero_eavesdropper(model_.states());
  }
  double eavesdropper_trace(const PublicTick& tick, const std::string& variant) const override {
    const MatrixXd& W = tick.nominal.W;
    if (variant != "zero" && astray(tick)) return std::numeric_limits<double>::quiet_NaN();
    if (variant == "differencing") {
      const double carried = static_cast<double>(noises_carried(tick.k, settings_.window)) * settings_.q_alpha;
      return (W * (tick.P + N_ + carried * design_.Pi)).cwiseProduct(W).sum();
    }
    if (variant == "window_mean" && tick.k >= settings_.window && steady_) return window_mean_;
    return variant == "zero" ? zero_ : std::numeric_limits<double>::quiet_NaN();
  }

  void declare(SignalScope& scope) override { meter_.declare(scope); }
  void publish(std::span<double> values) const override { meter_.publish(values); }
  std::vector<OwnMetric> metrics() const override { return meter_.metrics(); }

  Json design() const override {
    const auto& enough = design_.private_enough;
    Json design{{"gamma", design_.gamma},
                {"epsilon", settings_.epsilon},
                {"delta", settings_.delta},
                {"sigma", design_.sigma},
                {"q_xi", design_.q_xi},
                {"leak", design_.leak},
                {"slope", design_.slope},
                {"dp_ok", std::all_of(enough.begin(), enough.end(), [](bool one) { return one; })},
                {"W", matrix_json(design_.nominal.W)},
                {"Wc", matrix_json(design_.compensated.W)},
                {"views_design_mu", 1 / design_.gamma}};
    if (printed_) return design;  // views and releases are of sums of tq terms
    design["views"] = meter_.design(knowledge_.nodes);
    for (const LossView& view : meter_.views()) {
      const auto sensor = static_cast<std::size_t>(view.output);
      if (view.name == "single")
        add_releases(design, knowledge_.nodes[sensor], *knowledge_.plant,
                     design_.Qphi[sensor].diagonal().cwiseMax(0).cwiseSqrt(), view.shift);
    }
    return design;
  }

  std::vector<std::string> warnings() const override;

 private:
  /// The sums are those that do not telescope: no covariance is known.
  bool astray(const PublicTick& tick) const { return printed_ && tick.k > settings_.window; }

  Knowledge knowledge_;
  FusionModel model_;
  TwoStepSettings settings_;
  TwoStep design_;
  MatrixXd N_;     ///< of the first noise
  MatrixXd gain_;  ///< its root, (n L) x (n L)
  double root_alpha_;
  double window_mean_ = std::numeric_limits<double>::quiet_NaN();  ///< trace, in the stationary law
  double zero_ = std::numeric_limits<double>::quiet_NaN();
  Draws xi_draws_, alpha_draws_;
  bool printed_;
  TwoStepSender sender_, noise_sender_;
  TwoStepReceiver receiver_;
  bool steady_;  ///< every tick so far was in the filters' stationary law
  bool gaps_ = false;
  LossMeter meter_;
  VectorXd xi_, alpha_, eta_, hidden_, xp_, message_, guess_;
};

std::vector<std::string> TwoStepProtection::warnings() const {
  std::vector<std::string> warnings;
  const auto& enough = design_.private_enough;
  for (std::size_t i = 0; i < enough.size(); ++i) {
    if (enough[i]) continue;
    warnings.push_back(
        fmt::format("dp_ok is false: the noise of sensor {} is less than Theorem 4.1 asks for (epsilon, delta) privacy",
                    knowledge_.nodes[i]));
  }
  if (model_.count() == 1)
    warnings.emplace_back("there is one sensor alone, so no noise can be hidden in a null space");
  if (settings_.window == 1)
    warnings.emplace_back(
        "tq is 1: the null-space noise telescopes too, and the differencing eavesdropper does not "
        "diverge");
  if (design_.leak < kNoLeak * design_.nominal.P.trace())
    warnings.emplace_back(
        "leak is 0: the nominal weights let none of the null-space noise through, and no eavesdropper diverges");
  if (printed_)
    warnings.emplace_back(
        "the sums have tq + 1 terms, as (4-12) prints them: the printed decoder (4-18) does not telescope and the user "
        "diverges");
  if (gaps_)
    warnings.emplace_back(
        "a message was lost: the user's estimate goes on from its prediction, and as the decoder recurses on what it "
        "has lost, that error stays");
  if (!knowledge_.stationary)
    warnings.emplace_back(
        "the noises are designed for local filters in their stationary law, which this lane does not "
        "start in");
  return warnings;
}

const Registration<ProtectionMake> registration({
    "two_step",
    {"Two-step noise on sums over a window", "移动窗和两步噪声"},
    "seed 004, (4-11)-(4-29); specification (privacy), section 4",
    ParamTable({
        epsilon_param(),
        delta_param(),
        {.name = "zeta",
         .fallback = 0.1,
         .minimum = 0,
         .maximum = 1e9,
         .symbol = "ζ",
         .meaning = {"How far apart adjacent states may be (2-norm)", "相邻状态的最大距离（二范数）"}},
        {.name = "tq",
         .type = ParamType::integer,
         .fallback = 5,
         .minimum = 1,
         .maximum = 100,
         .symbol = "t_q",
         .meaning = {"Terms of a sum; with 1 nothing diverges", "移动窗长度；为 1 时窃听者不发散"}},
        {.name = "sum",
         .type = ParamType::text,
         .fallback = "corrected",
         .choices = {"corrected", "printed"},
         .meaning = {"Terms of a sum after the first tq: tq, or tq + 1 as (4-12) prints it",
                     "前 tq 步之后的求和项数：tq，或如 (4-12) 所印 tq + 1"}},
        {.name = "q_alpha",
         .fallback = 0.01,
         .minimum = 0,
         .maximum = 1e9,
         .symbol = "Q_α",
         .meaning = {"Variance of the null-space noise", "零空间噪声方差"}},
        adjacent_param(),
        {.name = "Rg",
         .type = ParamType::matrix,
         .nullable = true,
         .symbol = "R_i",
         .meaning = {"Gain of the first noise, of all sensors; null: I",
                     "第一步噪声增益（各传感器相同）；null 表示单位阵"}},
        {.name = "q_xi",
         .type = ParamType::vector,
         .nullable = true,
         .symbol = "Q_ξ",
         .meaning = {"Variance of the first noise of each sensor; null: as Theorem 4.1 asks",
                     "各传感器第一步噪声方差；null 表示按定理 4.1 设计"}},
    }),
    [](const Params& params, const Knowledge& knowledge) -> std::unique_ptr<Protection> {
      return std::make_unique<TwoStepProtection>(params, knowledge);
    },
});

}  // namespace
}  // namespace vigil::privacy
