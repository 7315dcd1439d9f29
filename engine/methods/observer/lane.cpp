/// Observers as a lane: one output a subsystem, each with its own states, attack and fault. Seed 002, (9)-(13).
#include "engine/methods/continuous_method.hpp"
#include "engine/methods/observer/matched.hpp"
#include "engine/methods/observer/settings.hpp"
#include "engine/methods/observer/stacked.hpp"

namespace vigil::observer {
namespace {

class ObserverLane final : public ContinuousMethod {
 public:
  ObserverLane(StackedObserver observer, Network network, const Knowledge& knowledge, std::vector<std::string> warnings)
      : observer_(std::move(observer)),
        network_(std::move(network)),
        nodes_(knowledge.nodes),
        design_(knowledge.design),
        warnings_(std::move(warnings)),
        z_(Eigen::VectorXd::Zero(observer_.size())) {
    said_.resize(network_.subsystems.size());
  }

  std::unique_ptr<Method> clone() const override { return std::make_unique<ObserverLane>(*this); }
  std::vector<std::string> outputs() const override { return nodes_; }
  std::vector<int> components(int output) const override {
    int first = 0;
    for (int i = 0; i < output; ++i) first += network_.subsystems[static_cast<std::size_t>(i)].n();
    std::vector<int> own;
    for (int c = 0; c < network_.subsystems[static_cast<std::size_t>(output)].n(); ++c) own.push_back(first + c);
    return own;
  }

  Eigen::VectorXd& flow_state() override { return z_; }
  const Eigen::VectorXd& flow_state() const override { return z_; }
  double fastest() const override { return observer_.fastest(); }
  void slope(const Eigen::Ref<const Eigen::VectorXd>& z, const Eigen::VectorXd& y, const Eigen::VectorXd& u,
             Eigen::Ref<Eigen::VectorXd> dz) override {
    observer_.slope(z, y, u, dz);
  }
  void settle(const Eigen::VectorXd& y, const Eigen::VectorXd& u) override { observer_.say(z_, y, u, said_); }

  Belief belief(int output) const override { return {.mean = said(output).xhat.data()}; }
  UnknownInputs unknown_inputs(int output) const override {
    const auto& own = said(output);
    return {.attack = own.what.size() > 0 ? own.what.data() : nullptr,
            .fault = own.fhat.size() > 0 ? own.fhat.data() : nullptr,
            .innovation = own.innovation.norm()};
  }
  bool has_bound() const override { return false; }
  Json design() const override { return design_; }
  std::vector<std::string> warnings() const override { return warnings_; }
  void retune(const Params& /*params*/) override {}
  void rewire(const Graph& /*graph*/, const std::vector<LinkRates>& /*rates*/) override {}

 private:
  const StackedObserver::Said& said(int output) const { return said_[static_cast<std::size_t>(output)]; }

  StackedObserver observer_;
  Network network_;
  std::vector<std::string> nodes_;
  Json design_;
  std::vector<std::string> warnings_;
  Eigen::VectorXd z_;
  std::vector<StackedObserver::Said> said_;
};

std::vector<std::string> warnings_of(const Settings& settings, const Json& record) {
  std::vector<std::string> warnings;
  if (settings.source == Source::printed) {
    warnings.emplace_back(
        "these are the source's printed gains, four digits each: their errors decay, but they do not estimate the "
        "attacks");
  } else if (settings.source == Source::given && !record.value("holds", false)) {
    warnings.emplace_back("these gains were given and have no certificate: " + record.value("reason", ""));
  }
  return warnings;
}

std::unique_ptr<Method> make_intermediate(const Params& params, const Knowledge& knowledge) {
  Settings settings = intermediate_settings(params, *knowledge.plant);
  const Gains gains = accepted_gains(settings, knowledge.design);
  return std::make_unique<ObserverLane>(StackedObserver::intermediate(settings.network, gains), settings.network,
                                        knowledge, warnings_of(settings, knowledge.design));
}

std::unique_ptr<Method> make_matched(const Params& params, const Knowledge& knowledge) {
  Settings settings = matched_settings(params, *knowledge.plant);
  const Gains gains = accepted_gains(settings, knowledge.design);
  std::vector<std::string> warnings;
  for (const Subsystem& s : settings.network.subsystems) {
    if (!matching_condition(s))
      warnings.push_back("subsystem " + s.name +
                         ": matching condition violated, rank(C D) < rank(D); it estimates no attack (fallback "
                         "(C D)^+ = 0)");
  }
  return std::make_unique<ObserverLane>(StackedObserver::matched(settings.network, gains), settings.network, knowledge,
                                        std::move(warnings));
}

const Registration<MethodMake> intermediate({
    "intermediate_observer",
    {"Distributed intermediate observer", "分布式中间观测器"},
    "seed 002, (9)-(13)",
    intermediate_params(),
    make_intermediate,
});

const Registration<MethodMake> matched_uio({
    "matched_observer",
    {"Matched unknown-input observer", "匹配条件未知输入观测器"},
    "specification (observer), section 8.2",
    matched_params(),
    make_matched,
});

const Registration<DesignMake> intermediate_design({
    "intermediate_observer",
    {"Gains from Theorem 1", "由定理 1 求增益"},
    "seed 002, (17)",
    ParamTable(),
    [](const Params& params, const Plant& plant) { return task_of(intermediate_settings(params, plant)); },
});

const Registration<DesignMake> matched_design({
    "matched_observer",
    {"Gains with a decay rate of 1/s", "衰减率为 1/s 的增益"},
    "specification (observer), section 8.2",
    ParamTable(),
    [](const Params& params, const Plant& plant) { return task_of(matched_settings(params, plant)); },
});

}  // namespace
}  // namespace vigil::observer
