/// Local filters that send their estimates to a fusion centre, with or without a protection on the way. Seed 004,
/// chapters 2-4; specification (privacy), sections 1-4.
#include "engine/core/input_error.hpp"
#include "engine/methods/fusion_method.hpp"
#include "engine/methods/privacy/centre.hpp"
#include "engine/methods/privacy/local_bank.hpp"
#include "engine/methods/privacy/unprotected.hpp"

namespace vigil::privacy {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

LocalKind kind_of(const Params& params) {
  const std::string filter = params.text("filter");
  if (filter == "stationary") return LocalKind::stationary;
  return filter == "time_varying" ? LocalKind::time_varying : LocalKind::extended;
}

/// The knowledge, if a fusion lane can be made of it.
const Knowledge& fit(const Knowledge& knowledge) {
  if (knowledge.graph.centre() < 0)
    throw InputError("", "this method sends to a fusion centre; expected network.graph \"centre\"", "centre");
  if (knowledge.plant->continuous())
    throw InputError("", "this method needs a plant in discrete time; the scenario's is in continuous time");
  return knowledge;
}

class FusionLane final : public Method, public FusionMethod {
 public:
  FusionLane(const Params& params, const Knowledge& knowledge)
      : ids_(fit(knowledge).nodes),
        plant_(knowledge.plant),
        periods_(periods_of(*plant_)),
        links_(knowledge.graph.links()),
        bank_(kind_of(params), params.boolean("printed_jacobian"), knowledge),
        tick_(bank_.begin()),
        protection_(knowledge.protection ? knowledge.protection->clone() : unprotected(knowledge)),
        centre_(knowledge, tick_),
        aligned_(bank_.means()),
        received_(MatrixXd::Zero(plant_->states(), static_cast<Eigen::Index>(ids_.size()))),
        lost_(ids_.size()) {
    fuse_locals();
    speak();
  }
  FusionLane(const FusionLane& other)
      : Method(other),
        FusionMethod(other),
        ids_(other.ids_),
        plant_(other.plant_),
        periods_(other.periods_),
        links_(other.links_),
        bank_(other.bank_),
        tick_(other.tick_),
        protection_(other.protection_->clone()),
        centre_(other.centre_),
        aligned_(other.aligned_),
        optimal_(other.optimal_),
        sent_(other.sent_),
        received_(other.received_),
        lost_(other.lost_),
        decoded_(other.decoded_) {}

  std::unique_ptr<Method> clone() const override { return std::make_unique<FusionLane>(*this); }
  std::vector<std::string> outputs() const override {
    auto outputs = ids_;
    outputs.emplace_back("fused");
    return outputs;
  }
  int message() const override { return plant_->states(); }
  const FusionMethod* fusion() const override { return this; }
  bool has_bound() const override { return false; }

  void predict(const VectorXd& input, FaultReport& /*report*/) override { bank_.predict(input, tick_); }
  void measure(const Readings& readings, FaultReport& report) override {
    if (!bank_.measure(readings, tick_, report)) return;
    fuse_locals();
    speak();
  }
  void send(int node, Eigen::Ref<VectorXd> message) const override { message = sent_.col(node); }
  void update(const Readings& /*readings*/, std::span<const Delivery> inbox, FaultReport& report) override {
    for (std::size_t l = 0; l < links_.size(); ++l) {
      const int from = links_[l].from;
      const bool heard = !inbox[l].lost && inbox[l].payload.allFinite();
      lost_[static_cast<std::size_t>(from)] = !heard;
      if (heard) received_.col(from) = inbox[l].payload;
    }
    protection_->decode(tick_, received_, lost_, decoded_);
    if (centre_.take(tick_, decoded_, *protection_)) return protection_->release(tick_, centre_.mean());
    if (std::string* text = report.stop(static_cast<int>(ids_.size()), "diverged"))
      *text = "the estimate at the fusion centre is no longer finite";
  }

  Belief belief(int output) const override {
    if (output < static_cast<int>(ids_.size())) return bank_.belief(output);
    const MatrixXd& P = centre_.covariance();
    return {.mean = centre_.mean().data(), .covariance = P.size() > 0 ? P.data() : nullptr};
  }

  const Protection& protection() const override { return *protection_; }
  const PublicTick& public_tick() const override { return tick_; }
  const VectorXd& optimal() const override { return optimal_; }
  double optimal_trace() const override { return tick_.nominal.P.trace(); }
  double legitimate_trace() const override {
    const MatrixXd& P = centre_.covariance();
    return P.size() > 0 ? P.trace() : std::numeric_limits<double>::quiet_NaN();
  }
  const double* compensated(int node) const override { return centre_.compensated(node); }
  double compensated_trace(int node) const override { return centre_.compensated_trace(node); }

  void declare(SignalScope& scope) override { protection_->declare(scope); }
  void publish(std::span<double> values) const override { protection_->publish(values); }
  Json design() const override { return protection_->design(); }
  std::vector<OwnMetric> metrics() const override { return protection_->metrics(); }
  std::vector<std::string> warnings() const override { return protection_->warnings(); }

  void retune(const Params& /*params*/) override {}
  void rewire(const Graph& graph, const std::vector<LinkRates>& /*rates*/) override {
    if (graph.centre() < 0) throw InputError("", "this method sends to a fusion centre; the new graph has none");
    links_ = graph.links();
  }

 private:
  void fuse_locals() {
    aligned_ = bank_.means();
    for (Eigen::Index i = 1; i < aligned_.cols(); ++i) to_turn_of(bank_.means().col(0), periods_, aligned_.col(i));
    optimal_.noalias() = tick_.nominal.W * aligned_.reshaped();
  }
  void speak() {
    sent_ = bank_.means();
    protection_->encode(tick_, sent_);
  }

  std::vector<std::string> ids_;
  std::shared_ptr<const Plant> plant_;
  std::vector<double> periods_;
  std::vector<Link> links_;
  LocalBank bank_;
  PublicTick tick_;
  std::unique_ptr<Protection> protection_;
  Centre centre_;
  MatrixXd aligned_;  ///< the local estimates, angles on the turn of the first
  VectorXd optimal_;
  MatrixXd sent_, received_;  ///< states x sensors
  std::vector<char> lost_;
  Decoded decoded_;
};

const Registration<MethodMake> registration({
    "fusion",
    {"Local filters and a fusion centre", "局部滤波与融合中心"},
    "seed 004, chapters 2-4; specification (privacy), section 1",
    ParamTable({
        {.name = "filter",
         .type = ParamType::text,
         .fallback = "extended",
         .choices = {"extended", "time_varying", "stationary"},
         .meaning =
             {"Local filters: linearised at their own estimates, or of a linear plant with the gain of the tick, "
              "or with the one of the long run",
              "局部滤波器：在自身估计处线性化，或线性对象的时变增益，或其稳态增益"}},
        {.name = "printed_jacobian",
         .type = ParamType::boolean,
         .fallback = false,
         .meaning =
             {"Sensors are linearised as their source prints it: (2-52) divides by the range where its square belongs",
              "按原文线性化传感器：(2-52) 应除以距离平方而印作距离"}},
    }),
    [](const Params& params, const Knowledge& knowledge) -> std::unique_ptr<Method> {
      return std::make_unique<FusionLane>(params, knowledge);
    },
});

}  // namespace
}  // namespace vigil::privacy
