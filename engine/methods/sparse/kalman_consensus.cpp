/// The Kalman-consensus filter: fuses the neighbours' information and pulls towards their predictions; knows nothing of
/// attacks. Olfati-Saber 2007; specification of seed 001, section 11, A3.
#include <fmt/format.h>

#include <Eigen/Dense>

#include "engine/methods/kalman.hpp"
#include "engine/methods/method.hpp"

namespace vigil {
namespace {

/// (P^-1 + S)^-1 for P, S positive semidefinite, P perhaps singular: with P = F F', it is F (I + F' S F)^-1 F'. NaN
/// where that overflows.
BoundedMatrix informed(const BoundedMatrix& P, const BoundedMatrix& S) {
  const auto n = P.rows();
  const Eigen::LDLT<BoundedMatrix> ldlt(P);
  BoundedMatrix F = ldlt.matrixL();
  F *= ldlt.vectorD().cwiseMax(0).cwiseSqrt().asDiagonal();
  F = (ldlt.transpositionsP().transpose() * F).eval();
  BoundedMatrix SF(n, n);
  SF.noalias() = S * F;
  BoundedMatrix A = BoundedMatrix::Identity(n, n);
  A.noalias() += F.transpose() * SF;
  const Eigen::LLT<BoundedMatrix> cholesky(A);
  if (cholesky.info() != Eigen::Success) return BoundedMatrix::Constant(n, n, std::nan(""));
  const BoundedMatrix W = cholesky.matrixL().solve(F.transpose());
  BoundedMatrix M(n, n);
  M.noalias() = W.transpose() * W;
  return M;
}

class KalmanConsensus final : public Method {
 public:
  KalmanConsensus(const Params& params, const Knowledge& knowledge)
      : plant_(knowledge.plant),
        sensors_(knowledge.sensors),
        ids_(knowledge.nodes),
        graph_(knowledge.graph),
        Q_(knowledge.Q) {
    const int n = plant_->states();
    for (Eigen::Index i = 0; i < knowledge.estimates.cols(); ++i) {
      const Gaussian start{knowledge.estimates.col(i), knowledge.P0};
      nodes_.push_back({start, start, {}, {}, BoundedVector::Zero(n), BoundedMatrix::Zero(n, n)});
    }
    retune(params);
  }

  std::unique_ptr<Method> clone() const override { return std::make_unique<KalmanConsensus>(*this); }
  std::vector<std::string> outputs() const override { return ids_; }
  int message() const override { return plant_->states(); }
  bool has_bound() const override { return false; }

  void predict(const Eigen::VectorXd& input, FaultReport& /*report*/) override {
    for (Node& node : nodes_) {
      kalman_predict(node.state, *plant_, input, Q_);
      node.prior = node.state;
    }
  }

  void measure(const Readings& readings, FaultReport& report) override {
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      Node& node = nodes_[i];
      node.evidence.setZero();
      node.information.setZero();
      node.innovation = innovate(*sensors_[i], readings[i], node.prior.mean, as_printed_);
      if (node.innovation.empty()) continue;
      warn_of_geometry(static_cast<int>(i), report);
      node.S = innovation_covariance(node.innovation, node.prior.covariance);
      const Eigen::LLT<BoundedMatrix> cholesky(node.innovation.R);
      const BoundedMatrix weighted = cholesky.solve(node.innovation.H);  // R^-1 C
      node.evidence.noalias() = weighted.transpose() * node.innovation.r;
      node.information.noalias() = node.innovation.H.transpose() * weighted;
      symmetrise(node.information);
    }
  }

  void send(int node, Eigen::Ref<Eigen::VectorXd> message) const override {
    message = nodes_[static_cast<std::size_t>(node)].prior.mean;
  }

  void update(const Readings& /*readings*/, std::span<const Delivery> inbox, FaultReport& report) override {
    for (int i = 0; i < static_cast<int>(nodes_.size()); ++i) {
      fuse(i, inbox);
      const Gaussian& state = nodes_[static_cast<std::size_t>(i)].state;
      if (state.mean.allFinite() && state.covariance.allFinite()) continue;
      if (std::string* text = report.stop(i, "diverged"))
        *text = fmt::format("node {}: the filter is no longer finite", ids_[static_cast<std::size_t>(i)]);
      return;
    }
  }

  Belief belief(int output) const override {
    const Node& node = nodes_[static_cast<std::size_t>(output)];
    Belief belief{.mean = node.state.mean.data(), .covariance = node.state.covariance.data()};
    if (!node.innovation.empty()) {
      belief.innovation = node.innovation.r.data();
      belief.innovation_covariance = node.S.data();
      belief.innovation_size = static_cast<int>(node.innovation.r.size());
    }
    return belief;
  }

  void retune(const Params& params) override {
    gain_ = params.real("gain");
    as_printed_ = params.boolean("printed_azimuth_row");
  }
  void rewire(const Graph& graph, const std::vector<LinkRates>& /*rates*/) override { graph_ = graph; }

 private:
  struct Node {
    Gaussian prior;  ///< xb, P
    Gaussian state;  ///< xhat, M
    Innovation innovation;
    BoundedMatrix S;            ///< its covariance
    BoundedVector evidence;     ///< C' R^-1 nu
    BoundedMatrix information;  ///< U = C' R^-1 C
  };

  /// What node j knows, as node i counts it: u_j - U_j xb_i, which is C_j' R^-1 nu_j + U_j (xb_j - xb_i). Both travel
  /// beside the message, as information that the source hands round unattacked.
  void fuse(int index, std::span<const Delivery> inbox) {
    Node& node = nodes_[static_cast<std::size_t>(index)];
    BoundedMatrix S = node.information;
    BoundedVector y = node.evidence, pull = BoundedVector::Zero(y.size());
    const int first = graph_.first_in(index);
    for (int l = first; l < first + graph_.degree(index); ++l) {
      const auto link = static_cast<std::size_t>(l);
      if (inbox[link].lost) continue;
      const Node& other = nodes_[static_cast<std::size_t>(graph_.links()[link].from)];
      S += other.information;
      y += other.evidence;
      y.noalias() += other.information * apart(other.prior.mean, node.prior.mean);
      pull += apart(inbox[link].payload, node.prior.mean);
    }
    const BoundedMatrix& P = node.prior.covariance;
    const double gamma = gain_ / (1 + P.norm());
    node.state.covariance = informed(P, S);
    node.state.mean = node.prior.mean;
    node.state.mean.noalias() += node.state.covariance * y;
    node.state.mean.noalias() += gamma * (P * pull).eval();
  }

  /// a - b, angles wrapped.
  BoundedVector apart(const Eigen::Ref<const Eigen::VectorXd>& a, const BoundedVector& b) const {
    BoundedVector difference = a - b;
    for (Eigen::Index c = 0; c < difference.size(); ++c)
      difference[c] = wrap(difference[c], plant_->state()[static_cast<std::size_t>(c)].period);
    return difference;
  }

  void warn_of_geometry(int index, FaultReport& report) const {
    const auto i = static_cast<std::size_t>(index);
    if (!sensors_[i]->limited(nodes_[i].prior.mean)) return;
    if (std::string* text = report.fault(index, "singular_geometry"))
      *text = fmt::format("node {}: the estimate stands where a bearing has no direction; its derivative was limited",
                          ids_[i]);
  }

  std::shared_ptr<const Plant> plant_;
  std::vector<std::shared_ptr<const Sensor>> sensors_;
  std::vector<std::string> ids_;
  Graph graph_;
  Eigen::MatrixXd Q_;
  double gain_ = 0.25;
  bool as_printed_ = false;
  std::vector<Node> nodes_;
};

const Registration<MethodMake> registration({
    "kalman_consensus",
    {"Kalman-consensus filter", "卡尔曼一致性滤波"},
    "Olfati-Saber 2007; specification of seed 001, section 11, A3",
    ParamTable({
        {.name = "gain",
         .fallback = 0.25,
         .minimum = 0,
         .live = true,
         .symbol = "γ",
         .meaning = {"Pull towards the neighbours' predictions, divided by 1 + ||P||_F",
                     "向邻居预测值靠拢的增益，再除以 1 + ||P||_F"}},
        {.name = "printed_azimuth_row",
         .type = ParamType::boolean,
         .fallback = false,
         .live = true,
         .meaning = {"Use the sensor's derivative as its source prints it", "使用论文所印的传感器导数"}},
    }),
    [](const Params& params, const Knowledge& knowledge) -> std::unique_ptr<Method> {
      return std::make_unique<KalmanConsensus>(params, knowledge);
    },
});

}  // namespace
}  // namespace vigil
