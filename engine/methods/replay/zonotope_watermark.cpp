/// A smart sensor that sends its residual, turned and marked in secret; the receiver asks whether what it decodes can
/// come from a healthy loop. Seed 003, reference [26]; specification, section 8.2.
#include "engine/core/describe.hpp"
#include "engine/linalg/riccati.hpp"
#include "engine/linalg/zonotope.hpp"
#include "engine/methods/method.hpp"
#include "engine/methods/replay/system.hpp"
#include "engine/methods/replay/watermark.hpp"
#include "engine/methods/replay/zonotope_filter.hpp"

namespace vigil::replay {
namespace {

constexpr double kMarginal = 1e-9;

ZonotopeSchedule make_schedule(const System& system, int order) {
  if (system.Mw.isZero(0) && system.Mv.isZero(0))
    throw InputError("/", "Mw and Mv are zero; the zonotope method expects bounded noise");
  if (order < system.states())
    throw InputError("/order", "order is " + std::to_string(order) + "; a zonotope of " +
                                   std::to_string(system.states()) + " dimensions keeps at least as many generators");
  if (const double radius = spectral_radius(system.A); radius > 1 + kMarginal)
    throw InputError("/",
                     named("A", system.A) + " and has the spectral radius " + number_text(radius) +
                         ": the receiver hears residuals alone, so that it drifts away from its sensor; expected a "
                         "plant that is stable by itself");
  auto schedule = ZonotopeSchedule::make(system.A, system.C, system.Mw, system.Mv, order);
  if (!schedule)
    throw InputError("/", named("Mv", system.Mv) +
                              ": the innovation matrix of the zonotope filter is not invertible; expected "
                              "bounded noise in every channel");
  return *schedule;
}

class ZonotopeWatermark final : public Method {
 public:
  ZonotopeWatermark(const Params& params, const Knowledge& knowledge)
      : system_(read_system(knowledge)),
        ids_(knowledge.nodes),
        at_sensor_(make_schedule(system_, params.integer("order"))),
        at_receiver_(at_sensor_),
        size_(params.real("rho") * at_sensor_.half_widths()),
        key_(knowledge.seed, "watermark.zonotope"),
        sensor_x_(knowledge.estimates.col(0)),
        x_(sensor_x_) {
    if (knowledge.monitor)
      throw InputError(
          "/", "the path is monitor; the zonotope method's receiver decodes what arrives: expected the path loop");
  }

  std::unique_ptr<Method> clone() const override { return std::make_unique<ZonotopeWatermark>(*this); }
  std::vector<std::string> outputs() const override { return ids_; }
  bool has_bound() const override { return false; }
  bool marks() const override { return true; }
  bool detects() const override { return true; }

  /// The smart sensor: it knows the applied input and keeps an estimate of its own.
  void emit(int /*node*/, const Eigen::VectorXd& reading, const Eigen::VectorXd& input,
            Eigen::VectorXd& sent) override {
    const BoundedVector predicted = system_.A * sensor_x_ + system_.B * input;
    sensor_x_ = predicted;
    const bool usable = reading.allFinite() && at_sensor_.advance();
    if (!usable) {
      at_sensor_.advance_unheard();
      sent.setConstant(std::numeric_limits<double>::quiet_NaN());
      return;
    }
    const BoundedVector z = reading - system_.C * predicted;
    sensor_x_ += at_sensor_.K() * z;
    sent = draw_mark(key_, k_ + 1, size_).apply(z);  // leaves before predict()
  }

  void predict(const Eigen::VectorXd& input, FaultReport& /*report*/) override {
    ++k_;
    const BoundedVector next = system_.A * x_ + system_.B * input;
    x_ = next;
  }

  void measure(const Readings& readings, FaultReport& report) override {
    const Eigen::VectorXd& arrived = readings.front();
    detection_ = {};
    if (!arrived.allFinite() || !at_receiver_.advance()) {
      at_receiver_.advance_unheard();
      if (std::string* text = report.fault(0, "no_reading")) *text = "no finite message; the prediction stands";
      return;
    }
    const BoundedVector z = draw_mark(key_, k_, size_).remove(arrived);
    detection_ = {ratio(at_receiver_.Z(), z), 1, true, !contains(at_receiver_.Z(), z)};
    if (!detection_.alarm) x_ += at_receiver_.K() * z;
  }

  Belief belief(int /*output*/) const override { return {.mean = x_.data()}; }
  Detection detection(int /*output*/) const override { return detection_; }
  Json design() const override { return {{"half_widths", to_json(at_sensor_.half_widths())}}; }
  std::vector<std::string> warnings() const override {
    if (system_.P.isZero(0) && system_.R.isZero(0)) return {};
    return {
        "the noise has a random part, which the healthy set does not hold: false alarms are possible, and after one "
        "the receiver no longer follows its sensor"};
  }
  void retune(const Params& params) override { size_ = params.real("rho") * at_sensor_.half_widths(); }
  void rewire(const Graph& /*graph*/, const std::vector<LinkRates>& /*rates*/) override {}

 private:
  System system_;
  std::vector<std::string> ids_;
  ZonotopeSchedule at_sensor_, at_receiver_;
  Eigen::VectorXd size_;  ///< rho h
  Draws key_;
  std::int64_t k_ = 0;
  BoundedVector sensor_x_, x_;
  Detection detection_;
};

const Registration<MethodMake> registration({
    "zonotope_watermark",
    {"Zonotope filter with a secret code", "带密钥编码的全对称多胞体滤波器"},
    "seed 003, reference [26]; specification, section 8.2",
    ParamTable({
        {.name = "rho",
         .fallback = 3.0,
         .minimum = 0,
         .maximum = 1e6,
         .live = true,
         .symbol = "ρ",
         .meaning = {"Size of the mark, in half widths of the healthy set; 0 is undetectable",
                     "水印幅值（健康集合半宽的倍数）；0 则无法检测"}},
        {.name = "order",
         .type = ParamType::integer,
         .fallback = 20,
         .minimum = 1,
         .maximum = 200,
         .meaning = {"Generators that are kept", "保留的生成元个数"}},
    }),
    [](const Params& params, const Knowledge& knowledge) -> std::unique_ptr<Method> {
      return std::make_unique<ZonotopeWatermark>(params, knowledge);
    },
});

}  // namespace
}  // namespace vigil::replay
