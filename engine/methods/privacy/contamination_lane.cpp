/// The protection `contamination`: which components are replaced by null-space noise in this tick, and that noise.
/// Seed 004, chapter 2; specification (privacy), section 2.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "engine/core/input_error.hpp"
#include "engine/methods/privacy/bounded_sets.hpp"
#include "engine/methods/privacy/contamination.hpp"
#include "engine/methods/privacy/eavesdroppers.hpp"
#include "engine/methods/privacy/null_space.hpp"
#include "engine/methods/privacy/start.hpp"
#include "engine/random/draws.hpp"

namespace vigil::privacy {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

bool linear(const Knowledge& knowledge) {
  return knowledge.plant->linear() &&
         std::all_of(knowledge.sensors.begin(), knowledge.sensors.end(), [](const auto& s) { return s->linear(); });
}

class Contamination final : public Protection {
 public:
  Contamination(const Params& params, const Knowledge& knowledge)
      : knowledge_(knowledge),
        n_(knowledge.plant->states()),
        count_(static_cast<int>(knowledge.sensors.size())),
        m_(params.integer("m")),
        linear_(linear(knowledge)),
        mode_(params.text("mode") == "exact" ? Selection::exact : Selection::norm),
        deviation_(std::sqrt(params.real("Q_a"))),
        draws_(knowledge.seed, "protection.contamination"),
        moment_(knowledge),
        h_(VectorXd::Ones(n_ * count_)),
        white_(n_ * count_) {
    sets_ = component_sets(n_ * count_, m_);
    if (!linear_ || !params.boolean("bounded_check")) return;
    check_ = bounded_check(fusion_model(knowledge));
    if (std::none_of(sets_.begin(), sets_.end(), [this](const ComponentSet& set) { return bounded(check_, set); }))
      throw InputError("/m",
                       fmt::format("m is {}, and every set of so many contaminated components lets the legitimate "
                                   "user's error grow without bound; expected another m, or bounded_check false",
                                   m_));
  }

  std::unique_ptr<Protection> clone() const override { return std::make_unique<Contamination>(*this); }

  /// Tick 0 goes as it is: there the centre has no prediction of its own.
  void encode(const PublicTick& tick, MatrixXd& messages) override {
    if (tick.k > 0 && linear_) moment_.step(tick.input);
    const bool still = tick.settled && chosen_settled_ && (!linear_ || moment_.settled());
    if (tick.k > 0 && !still) choose(tick);
    if (linear_ && !still) trace_ = eavesdropper_covariance(tick.nominal, tick.P, moment_.second(), h_).trace();
    if (tick.k == 0 || m_ == 0) return;
    draws_.normals(tick.k, white_);
    hidden_.noalias() = Pi_ * white_;
    for (Eigen::Index c = 0; c < h_.size(); ++c) {
      if (h_[c] == 0) messages.data()[c] = deviation_ * hidden_[c];
    }
  }

  void decode(const PublicTick& tick, const MatrixXd& received, std::span<const char> lost, Decoded& decoded) override {
    Protection::decode(tick, received, lost, decoded);
    decoded.h = decoded.h.cwiseProduct(h_);
  }

  std::unique_ptr<Eavesdropper> eavesdropper(const std::string& variant) const override {
    return variant == "zero" ? zero_eavesdropper(n_) : fusing_eavesdropper(knowledge_);
  }

  double eavesdropper_trace(const PublicTick& tick, const std::string& variant) const override {
    if (linear_ && variant == "fusing") return trace_;
    if (linear_ && variant == "zero") return moment_.second().trace();
    return Protection::eavesdropper_trace(tick, variant);
  }

  void declare(SignalScope& scope) override {
    slots_.clear();
    for (int i = 0; i < count_; ++i) {
      for (const Component& component : knowledge_.plant->state())
        slots_.push_back(scope.add(i, "contaminated." + component.name, "", SignalKind::boolean));
    }
  }
  void publish(std::span<double> values) const override {
    for (std::size_t c = 0; c < slots_.size(); ++c)
      values[static_cast<std::size_t>(slots_[c])] = h_[static_cast<Eigen::Index>(c)] == 0 ? 1 : 0;
  }

  Json design() const override {
    Json set = Json::array();
    for (Eigen::Index c = 0; c < h_.size(); ++c) {
      if (h_[c] == 0) set.push_back(c);
    }
    return {{"m", m_},
            {"mode", !linear_                   ? "worst_known"
                     : mode_ == Selection::norm ? "norm"
                                                : "exact"},
            {"contaminated", set},
            {"null_dim", null_dim_ < 0 ? Json(nullptr) : Json(null_dim_)}};
  }

  std::vector<std::string> warnings() const override {
    std::vector<std::string> sentences;
    if (m_ == 0) sentences.emplace_back("m is 0: nothing is contaminated");
    if (count_ == 1)
      sentences.emplace_back("there is one sensor, so the null space of the weights is trivial and the noise is zero");
    if (least_null_dim_ == 0 && m_ > 0)
      sentences.push_back(
          fmt::format("null_dim is 0 for m = {}: the contaminated components are sent as exact zeros, "
                      "not as noise",
                      m_));
    return sentences;
  }

 private:
  /// The best of the sets that leave the user bounded. Only those that would be chosen are tried.
  const ComponentSet& best_admissible(const PublicTick& tick) {
    for (;;) {
      const ComponentSet& best = choose_set(sets_, mode_, tick.nominal, tick.P, moment_.second());
      if (!check_ || passed_.contains(best)) return best;
      if (bounded(check_, best)) return *passed_.insert(best).first;
      sets_.erase(std::find(sets_.begin(), sets_.end(), best));
    }
  }

  /// This tick's set, by covariances alone, and the noise's null space.
  void choose(const PublicTick& tick) {
    const VectorXd h = kept(linear_ ? best_admissible(tick) : choose_worst_known(sets_, tick.P), n_ * count_);
    const bool same_space = tick.settled && chosen_settled_ && h == h_;
    h_ = h;
    chosen_settled_ = tick.settled;
    if (same_space) return;
    Pi_ = contamination_projector(tick.nominal.W, h_);
    null_dim_ = contamination_null_dim(tick.nominal.W, h_);
    least_null_dim_ = least_null_dim_ < 0 ? null_dim_ : std::min(least_null_dim_, null_dim_);
  }

  Knowledge knowledge_;
  int n_, count_, m_;
  bool linear_;
  Selection mode_;
  double deviation_;
  Draws draws_;
  StateMoment moment_;
  std::vector<ComponentSet> sets_;  ///< without those that were found to leave the user unbounded
  std::set<ComponentSet> passed_;
  std::shared_ptr<const BoundedCheck> check_;  ///< null: every set is admissible
  VectorXd h_, white_, hidden_;
  MatrixXd Pi_;
  double trace_ = 0;                         ///< of the fusing eavesdropper's covariance
  bool chosen_settled_ = false;              ///< h_ and Pi_ were made in a settled tick
  int null_dim_ = -1, least_null_dim_ = -1;  ///< -1: not yet known
  std::vector<int> slots_;
};

const Registration<ProtectionMake> registration({
    "contamination",
    {"Null-space noise in some components", "部分分量的零空间噪声污染"},
    "seed 004, chapter 2; specification (privacy), section 2",
    ParamTable({
        {.name = "m",
         .type = ParamType::integer,
         .fallback = 3,
         .minimum = 0,
         .meaning = {"Contaminated components over all sensors", "全部传感器中被污染的分量总数"}},
        {.name = "mode",
         .type = ParamType::text,
         .fallback = "norm",
         .choices = {"norm", "exact"},
         .meaning = {"How the set is chosen on a linear plant: the paper's norm, or the eavesdropper's exact trace",
                     "线性对象上集合的选取：论文范数准则，或窃听者误差协方差的精确迹"}},
        {.name = "bounded_check",
         .type = ParamType::boolean,
         .fallback = true,
         .meaning = {"Leave out sets that make the legitimate user's error unbounded (linear plants)",
                     "排除使合法用户误差无界的集合（线性对象）"}},
        {.name = "Q_a",
         .fallback = 1.0,
         .minimum = 0,
         .maximum = 1e12,
         .symbol = "Q_a",
         .meaning = {"Variance of the white noise before it is projected", "投影前白噪声的方差"}},
    }),
    [](const Params& params, const Knowledge& knowledge) -> std::unique_ptr<Protection> {
      return std::make_unique<Contamination>(params, knowledge);
    },
});

}  // namespace
}  // namespace vigil::privacy
