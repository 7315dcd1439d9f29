/// The plain unbiased-FIR filter: every tick anew over the last N readings. Seed 003, eq. (4); specification, section
/// 4.2.
#include <Eigen/LU>

#include "engine/methods/method.hpp"
#include "engine/methods/replay/start.hpp"

namespace vigil::replay {
namespace {

class UfirFilter final : public Method {
 public:
  UfirFilter(const Params& params, const Knowledge& knowledge)
      : system_(read_system(knowledge)),
        ids_(knowledge.nodes),
        start_(system_),
        horizon_(params.integer("N")),
        Y_(Eigen::MatrixXd::Zero(system_.channels(), horizon_)),
        U_(Eigen::MatrixXd::Zero(system_.B.cols(), horizon_)),
        x_(knowledge.estimates.col(0)) {
    if (horizon_ < system_.states())
      throw InputError("/N", "N is " + std::to_string(horizon_) + "; expected at least " +
                                 std::to_string(system_.states()) +
                                 ", as many readings as the plant has states start the filter");
    set_gains();
  }

  std::unique_ptr<Method> clone() const override { return std::make_unique<UfirFilter>(*this); }
  std::vector<std::string> outputs() const override { return ids_; }
  bool ready() const override { return started_; }
  bool has_bound() const override { return false; }

  void predict(const Eigen::VectorXd& input, FaultReport& /*report*/) override {
    input_ = input;
    if (started_) advance(input_);
  }

  void measure(const Readings& readings, FaultReport& report) override {
    const Eigen::VectorXd& reading = readings.front();
    if (!reading.allFinite() || !input_.allFinite()) {  // predict alone until the window has filled again
      count_ = 0;
      if (std::string* text = report.fault(0, "no_reading")) *text = "no finite reading; the prediction stands";
      return;
    }
    if (count_ == horizon_) {
      for (Eigen::Index c = 0; c + 1 < Y_.cols(); ++c) {
        Y_.col(c) = Y_.col(c + 1);
        U_.col(c) = U_.col(c + 1);
      }
      --count_;
    }
    Y_.col(count_) = reading;
    U_.col(count_++) = input_;
    if (count_ >= system_.states()) filter();
  }

  Belief belief(int /*output*/) const override { return {.mean = x_.data()}; }
  void retune(const Params& /*params*/) override {}
  void rewire(const Graph& /*graph*/, const std::vector<LinkRates>& /*rates*/) override {}

 private:
  /// They depend on no reading, only on how many came before in the horizon.
  void set_gains() {
    Eigen::MatrixXd G = start_.batch().G();
    const Eigen::MatrixXd CC = system_.C.transpose() * system_.C;
    for (int l = system_.states(); l < horizon_; ++l) {
      const Eigen::MatrixXd AGA = system_.A * G * system_.A.transpose();
      G = (CC + AGA.inverse()).inverse();  // both regular: A and H have full rank
      gains_.emplace_back(G * system_.C.transpose());
    }
  }

  void advance(const Eigen::Ref<const Eigen::VectorXd>& input) {
    BoundedVector next = system_.B * input;
    next.noalias() += system_.A * x_;
    x_ = next;
  }

  void filter() {
    const Eigen::Index n = system_.states();
    x_ = start_.batch().estimate(Y_.leftCols(n), U_.leftCols(n));
    for (Eigen::Index l = n; l < count_; ++l) {
      advance(U_.col(l));
      BoundedVector innovation = Y_.col(l);
      innovation.noalias() -= system_.C * x_;
      x_.noalias() += gains_[static_cast<std::size_t>(l - n)] * innovation;
    }
    started_ = true;
  }

  System system_;
  std::vector<std::string> ids_;
  Start start_;
  int horizon_, count_ = 0;
  Eigen::MatrixXd Y_, U_;             ///< the last readings and the inputs before them, oldest first
  std::vector<BoundedMatrix> gains_;  ///< G C' of the readings after the batch
  Eigen::VectorXd input_;
  BoundedVector x_;
  bool started_ = false;
};

const Registration<MethodMake> registration({
    "ufir_filter",
    {"Unbiased FIR filter", "无偏有限脉冲响应滤波器"},
    "seed 003, eq. (4)",
    ParamTable({
        {.name = "N",
         .type = ParamType::integer,
         .fallback = 10,
         .minimum = 1,
         .maximum = 1000,
         .symbol = "N",
         .meaning = {"Readings in the horizon", "时域长度"}},
    }),
    [](const Params& params, const Knowledge& knowledge) -> std::unique_ptr<Method> {
      return std::make_unique<UfirFilter>(params, knowledge);
    },
});

}  // namespace
}  // namespace vigil::replay
