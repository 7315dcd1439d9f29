/// The consensus filter as a method, and its variants without attack knowledge: seed 000, sections 5 to 9 of the
/// specification.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/methods/consensus/kernel.hpp"
#include "engine/methods/method.hpp"

namespace vigil::consensus {

/// What the receiver knows of an attack: section 9.
enum class Mode {
  filter,      ///< sees lost packets, uses falsified ones
  drop,        ///< an oracle flags falsified packets, which are discarded
  naive_hold,  ///< knows nothing; on a lost packet uses the last one received
  naive_zero,  ///< knows nothing; a lost packet reads as the zero vector
};

/// Parameters of the method after parsing.
struct Settings {
  Constants constants;
  Mode mode = Mode::filter;
  bool automatic_eps = true;
  bool knows_rates = true;
  std::optional<double> phibar, gammabar, delta;  ///< given: in place of what the adversary publishes
  Eigen::MatrixXd U;                              ///< states x states
  Params raw;                                     ///< for what depends on a sensor's size: V
};

/// Reads and checks. Throws InputError with pointers relative to the params.
Settings read_settings(const Params& params, int states, const Graph& graph, const std::vector<LinkRates>& rates);

/// Rates as the filter uses them on each link: given values, the mode's own rule (section 9), or what is published.
std::vector<LinkRates> effective_rates(const Settings& settings, const std::vector<LinkRates>& published);

/// Sizes (3, 2) and (3, 3) are compiled fixed; everything else up to kMaxSmall runs on bounded matrices.
template <int N, int M>
class Filter final : public Method {
 public:
  Filter(const Params& params, const Knowledge& knowledge);

  std::unique_ptr<Method> clone() const override { return std::make_unique<Filter>(*this); }
  std::vector<std::string> outputs() const override { return ids_; }
  int message() const override { return states_; }
  void declare(SignalScope& scope) override;
  void predict(const Eigen::VectorXd& input, FaultReport& report) override;
  void send(int node, Eigen::Ref<Eigen::VectorXd> message) const override { message = at(node).xp; }
  void update(const Readings& readings, std::span<const Delivery> inbox, FaultReport& report) override;
  Belief belief(int output) const override;
  void publish(std::span<double> values) const override;
  Json design() const override;
  std::vector<OwnMetric> metrics() const override;
  void retune(const Params& params) override;
  void rewire(const Graph& graph, const std::vector<LinkRates>& rates) override;

 private:
  using NodeState = Node<N, M>;
  struct Slots {
    int feasible28, feasible29, lambda_max, lost;
  };

  const NodeState& at(int node) const { return nodes_[static_cast<std::size_t>(node)]; }
  void apply_settings(Settings settings);
  Received<N> receive(int node, std::span<const Delivery> inbox);
  void observe(NodeState& node, int index, const Eigen::VectorXd& reading, typename NodeState::MatMN& H) const;
  void judge(int node, FaultReport& report);
  void widen_spectrum();
  bool naive() const { return settings_.mode == Mode::naive_hold || settings_.mode == Mode::naive_zero; }

  std::shared_ptr<const Plant> plant_;
  std::vector<std::shared_ptr<const Sensor>> sensors_;
  std::vector<std::string> ids_;
  Eigen::MatrixXd Q_;
  Graph graph_;
  std::vector<LinkRates> published_, rates_;
  int states_;
  Settings settings_;
  std::vector<NodeState> nodes_;
  std::vector<typename NodeState::VecN> held_;  ///< naive modes: last value received, one a link
  std::vector<int> lost_;                       ///< packets lost in this tick, one a node
  std::vector<Slots> slots_;

  std::int64_t tick_ = 0;
  std::int64_t first_infeasible_ = 0;  ///< 0: never
  double min_eigenvalue_, max_eigenvalue_;
};

extern template class Filter<3, 2>;
extern template class Filter<3, 3>;
extern template class Filter<Eigen::Dynamic, Eigen::Dynamic>;

/// The fixed kernel where one fits, the bounded one else. `force_bounded` is for the test that compares the two.
std::unique_ptr<Method> make_filter(const Params& params, const Knowledge& knowledge, bool force_bounded = false);

}  // namespace vigil::consensus
