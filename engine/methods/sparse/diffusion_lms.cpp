/// Secure diffusion LMS: each node adapts alone and together, and trusts those whose estimate lies near the median of
/// what all have found alone. After Liu and Li 2018; specification of seed 001, section 11, A5.
#include <fmt/format.h>

#include <algorithm>

#include "engine/methods/kalman.hpp"
#include "engine/methods/method.hpp"

namespace vigil {
namespace {

/// Reorders `values`. For an even count: the mean of the middle two.
double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

class DiffusionLms final : public Method {
 public:
  DiffusionLms(const Params& params, const Knowledge& knowledge)
      : plant_(knowledge.plant), sensors_(knowledge.sensors), ids_(knowledge.nodes), graph_(knowledge.graph) {
    for (Eigen::Index i = 0; i < knowledge.estimates.cols(); ++i) {
      const BoundedVector start = knowledge.estimates.col(i);
      nodes_.push_back({start, start, start});
    }
    values_.reserve(ids_.size());
    retune(params);
  }

  std::unique_ptr<Method> clone() const override {
    auto copy = std::make_unique<DiffusionLms>(*this);
    copy->values_.reserve(ids_.size());
    return copy;
  }
  std::vector<std::string> outputs() const override { return ids_; }
  int message() const override { return plant_->states(); }
  bool has_bound() const override { return false; }

  void predict(const Eigen::VectorXd& input, FaultReport& /*report*/) override {
    BoundedVector before(plant_->states());
    for (Node& node : nodes_) {
      before = node.alone;
      plant_->advance(before, input, node.alone);
      plant_->advance(node.together, input, node.adapted);
    }
  }

  void measure(const Readings& readings, FaultReport& report) override {
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      adapt(i, readings[i], nodes_[i].alone, report);
      adapt(i, readings[i], nodes_[i].adapted, report);
    }
  }

  void send(int node, Eigen::Ref<Eigen::VectorXd> message) const override {
    message = nodes_[static_cast<std::size_t>(node)].adapted;
  }

  void update(const Readings& /*readings*/, std::span<const Delivery> inbox, FaultReport& report) override {
    for (int i = 0; i < static_cast<int>(nodes_.size()); ++i) {  // before any is compared with others
      const Node& node = nodes_[static_cast<std::size_t>(i)];
      if (!node.alone.allFinite() || !node.adapted.allFinite()) return stop(i, report);
    }
    for (int i = 0; i < static_cast<int>(nodes_.size()); ++i) {
      combine(i, inbox);
      if (!nodes_[static_cast<std::size_t>(i)].together.allFinite()) return stop(i, report);
    }
  }

  Belief belief(int output) const override {
    return {.mean = nodes_[static_cast<std::size_t>(output)].together.data()};
  }

  void retune(const Params& params) override {
    mu_ = params.real("mu");
    trust_ = params.real("trust");
    as_printed_ = params.boolean("printed_azimuth_row");
  }
  void rewire(const Graph& graph, const std::vector<LinkRates>& /*rates*/) override { graph_ = graph; }

 private:
  struct Node {
    BoundedVector alone;     ///< a: never listens
    BoundedVector adapted;   ///< psi: what it sends
    BoundedVector together;  ///< w: the estimate
  };

  void adapt(std::size_t i, const Eigen::VectorXd& reading, BoundedVector& z, FaultReport& report) const {
    const Innovation innovation = innovate(*sensors_[i], reading, z, as_printed_);
    if (innovation.empty()) return;
    if (sensors_[i]->limited(z)) {
      if (std::string* text = report.fault(static_cast<int>(i), "singular_geometry"))
        *text = fmt::format("node {}: the estimate stands where a bearing has no direction; its derivative was limited",
                            ids_[i]);
    }
    z.noalias() += mu_ * (innovation.H.transpose() * innovation.r).eval();
  }

  void stop(int index, FaultReport& report) const {
    if (std::string* text = report.stop(index, "diverged"))
      *text = fmt::format("node {}: the estimate is no longer finite", ids_[static_cast<std::size_t>(index)]);
  }

  /// The median of a_l over the node itself and those it heard from; a_l travels beside the message.
  BoundedVector reference(int index, std::span<const Delivery> inbox) {
    const Node& node = nodes_[static_cast<std::size_t>(index)];
    const int first = graph_.first_in(index);
    BoundedVector result = node.alone;
    for (Eigen::Index c = 0; c < result.size(); ++c) {
      values_.assign(1, node.alone[c]);
      for (int l = first; l < first + graph_.degree(index); ++l) {
        const auto link = static_cast<std::size_t>(l);
        if (inbox[link].lost) continue;
        const Node& other = nodes_[static_cast<std::size_t>(graph_.links()[link].from)];
        values_.push_back(near(other.alone[c], node.alone[c], c));
      }
      result[c] = median(values_);
    }
    return result;
  }

  void combine(int index, std::span<const Delivery> inbox) {
    Node& node = nodes_[static_cast<std::size_t>(index)];
    const BoundedVector middle = reference(index, inbox);
    BoundedVector sum = BoundedVector::Zero(middle.size()), heard(middle.size());
    int trusted = 0;
    const auto weigh = [&](const auto& psi) {
      for (Eigen::Index c = 0; c < middle.size(); ++c) heard[c] = near(psi[c], middle[c], c);
      if (!((heard - middle).squaredNorm() <= trust_)) return;  // a message that is no number is not trusted
      sum += heard;
      ++trusted;
    };
    weigh(node.adapted);
    const int first = graph_.first_in(index);
    for (int l = first; l < first + graph_.degree(index); ++l) {
      const Delivery& delivery = inbox[static_cast<std::size_t>(l)];
      if (!delivery.lost) weigh(delivery.payload);
    }
    node.together = trusted > 0 ? BoundedVector(sum / trusted) : middle;
  }

  /// An angle taken to the turn of `anchor`; any other value as it is.
  double near(double value, double anchor, Eigen::Index component) const {
    const double period = plant_->state()[static_cast<std::size_t>(component)].period;
    return period == 0 ? value : anchor + wrap(value - anchor, period);
  }

  std::shared_ptr<const Plant> plant_;
  std::vector<std::shared_ptr<const Sensor>> sensors_;
  std::vector<std::string> ids_;
  Graph graph_;
  double mu_ = 0.3, trust_ = 1;
  bool as_printed_ = false;
  std::vector<Node> nodes_;
  std::vector<double> values_;  ///< of one component, at a node and its neighbours
};

const Registration<MethodMake> registration({
    "diffusion_lms",
    {"Secure diffusion LMS", "安全扩散 LMS"},
    "after Liu and Li 2018; specification of seed 001, section 11, A5",
    ParamTable({
        {.name = "mu",
         .fallback = 0.3,
         .minimum = 0,
         .live = true,
         .symbol = "μ",
         .meaning = {"Step of the adaptation", "自适应步长"}},
        {.name = "trust",
         .fallback = 1.0,
         .minimum = 0,
         .live = true,
         .meaning = {"A neighbour is trusted up to this squared distance from the median (units of the state mixed)",
                     "与中位数的距离平方不超过该值的邻居被信任（混用各状态单位）"}},
        {.name = "printed_azimuth_row",
         .type = ParamType::boolean,
         .fallback = false,
         .live = true,
         .meaning = {"Use the sensor's derivative as its source prints it", "使用论文所印的传感器导数"}},
    }),
    [](const Params& params, const Knowledge& knowledge) -> std::unique_ptr<Method> {
      return std::make_unique<DiffusionLms>(params, knowledge);
    },
});

}  // namespace
}  // namespace vigil
