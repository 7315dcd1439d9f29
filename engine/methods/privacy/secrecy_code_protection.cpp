#include <algorithm>
#include <map>
#include <utility>

#include "engine/core/missing.hpp"
#include "engine/methods/privacy/eavesdroppers.hpp"
#include "engine/methods/privacy/mechanism_params.hpp"
#include "engine/methods/privacy/protection.hpp"
#include "engine/methods/privacy/secrecy_code.hpp"
#include "engine/methods/privacy/secrecy_eavesdropper.hpp"
#include "engine/random/draws.hpp"

namespace vigil::privacy {
namespace {

using Eigen::MatrixXd;

constexpr int kDepth = 5;  // messages that the eavesdropper of a leaking code puts together

StationaryFilters filters_of(const FusionModel& model) {
  auto filters = stationary_filters(model);
  if (!filters) throw InputError("", "a sensor's filter has no stationary law: the target is not detectable from it");
  return std::move(*filters);
}

/// One Lc a sensor.
std::vector<MatrixXd> codes_of(const std::string& code, const FusionModel& model, const StationaryFilters& filters) {
  const auto count = static_cast<std::size_t>(model.count());
  if (code == "A") return std::vector<MatrixXd>(count, model.A);
  if (code == "L") {
    if (auto own = code_l(model, filters)) return std::move(*own);
  } else if (const auto common = code_l_state(model)) {
    return std::vector<MatrixXd>(count, *common);
  }
  throw InputError("/code", "this code needs a stable plant whose A can be inverted", "A");
}

class SecrecyCode final : public Protection {
 public:
  SecrecyCode(const Params& params, const Knowledge& knowledge)
      : knowledge_(knowledge),
        model_(fusion_model(knowledge)),
        code_(params.text("code")),
        loss_(params.real("loss")),
        draws_(knowledge.seed, "protection.loss"),
        filters_(filters_of(model_)),
        codes_(codes_of(code_, model_, filters_)),
        steady_(knowledge.stationary) {
    memories_ = std::vector<CodeMemory>(codes_.begin(), codes_.end());
    const auto S = state_covariance(model_);
    if (S && knowledge.stationary) prior_trace_ = S->trace();
    if (code_ == "A") {
      if (knowledge.stationary) code_a_.emplace(model_, filters_, loss_);
      const auto P = code_a_eavesdropper(model_, filters_, fuse(filters_.P, model_.states()), loss_);
      if (P) lasting_trace_ = P->trace();
    } else {
      recent_.emplace(model_, filters_, *S, codes_, kDepth);
      heard_.assign(static_cast<std::size_t>(kDepth * model_.count()), 0);
    }
  }
  std::unique_ptr<Protection> clone() const override { return std::make_unique<SecrecyCode>(*this); }

  void encode(const PublicTick& tick, MatrixXd& messages) override {
    for (std::size_t i = 0; i < memories_.size(); ++i) {
      memories_[i].advance();
      messages.col(static_cast<Eigen::Index>(i)) -= memories_[i].base();
    }
    heard_now_ = !draws_.bernoulli(tick.k, 0, loss_);
    missed_ = missed_ || !heard_now_;
    steady_ = steady_ && (tick.settled || stationary(tick, filters_));
    if (code_a_ && steady_ && tick.k > 0) code_a_->step();
    if (!recent_ || tick.k == 0) return;
    std::rotate(heard_.begin(), heard_.end() - model_.count(), heard_.end());
    std::fill_n(heard_.begin(), model_.count(), static_cast<char>(heard_now_));
  }

  void decode(const PublicTick& tick, const MatrixXd& received, std::span<const char> lost, Decoded& decoded) override {
    Protection::decode(tick, received, lost, decoded);
    for (std::size_t i = 0; i < memories_.size(); ++i) {
      if (lost[i]) continue;
      const auto column = static_cast<Eigen::Index>(i);
      decoded.estimates.col(column) = memories_[i].decode(received.col(column));
    }
  }

  std::unique_ptr<Eavesdropper> eavesdropper(const std::string& variant) const override {
    if (variant == "zero") return zero_eavesdropper(model_.states());
    if (code_ == "A") return code_a_listener(model_);
    return code_l_listener(model_, codes_, code_ == "L_state" ? recent_ : std::nullopt);
  }
  bool audible(int /*sensor*/) const override { return heard_now_; }
  double eavesdropper_trace(const PublicTick& tick, const std::string& variant) const override {
    if (variant == "zero" || (code_ == "L" && missed_)) return prior_trace_;
    if (code_ == "A") return code_a_trace(tick);
    return missed_ ? recent_trace() : tick.nominal.P.trace();
  }

  Json design() const override {
    Json design{{"code", code_}, {"loss", loss_}};
    for (const MatrixXd& Lc : codes_) design["Lc"].push_back(matrix_json(Lc));
    if (!recent_) return design;
    for (const int messages : {1, 2, kDepth}) {
      std::vector<char> heard(heard_.size(), 0);
      std::fill_n(heard.begin(), messages * model_.count(), static_cast<char>(1));
      design["leak_after"][std::to_string(messages)] = recent_->best(heard).trace;
    }
    return design;
  }
  std::vector<std::string> warnings() const override {
    std::vector<std::string> warnings;
    if (code_ == "L_state")
      warnings.emplace_back("this code leaks: its Lc comes from the covariance of the state instead of the estimates'");
    const auto again = [](const CodeMemory& memory) { return memory.restarted(); };
    if (std::any_of(memories_.begin(), memories_.end(), again))
      warnings.emplace_back(
          "so many messages in a row were lost that a sensor began anew with one that is not coded: the code's powers "
          "had passed 1e9");
    return warnings;
  }

 private:
  double code_a_trace(const PublicTick& tick) const {
    if (code_a_ && steady_) return code_a_->trace(tick.nominal.W);
    return tick.settled ? lasting_trace_ : kMissing;
  }
  /// For what this mechanism let through; known as the eavesdropper's figure where all of that was overheard.
  double recent_trace() const {
    const auto found = traces_.find(heard_);
    return found != traces_.end() ? found->second : traces_.emplace(heard_, recent_->best(heard_).trace).first->second;
  }

  Knowledge knowledge_;
  FusionModel model_;
  std::string code_;
  double loss_;
  Draws draws_;
  StationaryFilters filters_;
  std::vector<MatrixXd> codes_;
  bool steady_;                       ///< every tick so far was in the filters' stationary law
  std::vector<CodeMemory> memories_;  ///< of sensors and user alike
  double prior_trace_ = kMissing;
  std::optional<CodeAError> code_a_;
  double lasting_trace_ = kMissing;  ///< of code A, in the long run
  std::optional<RecentMessages> recent_;
  std::vector<char> heard_;  ///< as RecentMessages has it
  mutable std::map<std::vector<char>, double> traces_;
  bool heard_now_ = true, missed_ = false;
};

const Registration<ProtectionMake> registration({
    "secrecy_code",
    {"State-secrecy code", "状态保密编码"},
    "Tsiamis, Gatsis and Pappas; specification (privacy), section 4.6",
    ParamTable({
        {.name = "code",
         .type = ParamType::text,
         .fallback = "A",
         .choices = {"A", "L", "L_state"},
         .symbol = "L_c",
         .meaning = {"A: the plant's matrix; L: of each sensor, from the covariance of its estimates; L_state: one for "
                     "all, from that of the state, which leaks",
                     "A：对象矩阵；L：各传感器由其估计协方差得到；L_state：共用一个，由状态协方差得到（会泄漏）"}},
        {.name = "loss",
         .fallback = 0.36,
         .minimum = 0,
         .maximum = 1,
         .meaning = {"Probability with which the eavesdropper misses all messages of a tick",
                     "窃听者漏收某一时刻全部消息的概率"}},
    }),
    [](const Params& params, const Knowledge& knowledge) -> std::unique_ptr<Protection> {
      return std::make_unique<SecrecyCode>(params, knowledge);
    },
});

}  // namespace
}  // namespace vigil::privacy
