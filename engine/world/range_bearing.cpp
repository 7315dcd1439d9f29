/// A landmark that the robot sees: range, and bearing in the robot's frame. The geometry of seed 000 with the ray
/// turned round.
#include <cmath>
#include <limits>

#include "engine/world/sensor.hpp"

namespace vigil {
namespace {

class RangeBearing final : public Sensor {
 public:
  RangeBearing(const Params& params, const Plant& plant)
      : position_(params.vector("position")), noise_(params.square("R", 2)) {
    if (plant.states() != 3) throw InputError("/", "range and bearing need a plant with the state (x, y, theta)");
    const Component& heading = plant.state()[2];
    radians_ = 2 * std::acos(-1.0) / heading.period;
    channels_ = {{"range", plant.state()[0].unit, 0}, {"bearing", heading.unit, heading.period}};
  }

  const std::vector<Component>& channels() const override { return channels_; }
  const Eigen::MatrixXd& noise() const override { return noise_; }
  std::optional<Eigen::Vector2d> position() const override { return position_; }

  void measure(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Ref<Eigen::VectorXd> z) const override {
    const double dx = position_[0] - x[0], dy = position_[1] - x[1];
    z[0] = std::hypot(dx, dy);
    z[1] = wrap(std::atan2(dy, dx) / radians_ - x[2], channels_[1].period);
  }

  void jacobian(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Ref<Eigen::MatrixXd> H) const override {
    const double dx = position_[0] - x[0], dy = position_[1] - x[1];
    // On top of the landmark the bearing has no direction: its row is zero there, and the reading teaches nothing of
    // it.
    const double r2 = std::max(dx * dx + dy * dy, std::numeric_limits<double>::min());
    const double r = std::sqrt(r2);
    H(0, 0) = -dx / r;
    H(0, 1) = -dy / r;
    H(0, 2) = 0;
    H(1, 0) = dy / (r2 * radians_);
    H(1, 1) = -dx / (r2 * radians_);
    H(1, 2) = -1;
  }

 private:
  Eigen::Vector2d position_;
  Eigen::MatrixXd noise_;
  double radians_ = 1;  ///< per unit of the heading
  std::vector<Component> channels_;
};

const Registration<SensorMake> registration({
    "range_bearing",
    {"Range and bearing to a landmark", "到路标的距离与方位"},
    "recorded robots; seed 000, section 4 in its geometry",
    ParamTable({
        {.name = "position",
         .type = ParamType::vector,
         .rows = 2,
         .nullable = true,
         .meaning = {"Place of the landmark; none given: from the trace's columns node.<id>.position.x and .y",
                     "路标位置；未给出时取自记录的 node.<id>.position.x 与 .y 列"}},
        {.name = "R",
         .type = ParamType::matrix,
         .fallback = Json::array({0.0225, 0.0036}),
         .symbol = "R",
         .meaning = {"Covariance of range and bearing noise", "距离与方位噪声的协方差"}},
    }),
    [](const Params& params, const Plant& plant) -> std::shared_ptr<const Sensor> {
      if (!params.given("position")) {
        throw InputError("/position",
                         "no position is given and the run has no trace with columns node.<id>.position.x and .y");
      }
      return std::make_shared<RangeBearing>(params, plant);
    },
});

}  // namespace
}  // namespace vigil
