/// The plants of seed 002's examples, one of the user's own, and the sensor of a subsystem.
#include <fmt/format.h>

#include "engine/world/interconnected/examples.hpp"
#include "engine/world/interconnected/plant.hpp"

namespace vigil::observer {
namespace {

std::shared_ptr<const Plant> plant_of(Network network, double dt) {
  return std::make_shared<InterconnectedPlant>(std::move(network), dt);
}

Param shape_param() {
  return {.name = "phi",
          .type = ParamType::text,
          .fallback = "sine",
          .choices = {"sine", "tanh", "sine_last", "none"},
          .symbol = "Φ",
          .meaning = {"Shape of the known nonlinearity; the source gives none", "已知非线性的形状；原文未给出"}};
}

Network shaped(Network network, const Params& params) {
  const std::string shape = params.text("phi");
  for (Subsystem& s : network.subsystems) {
    s.phi = shape == "sine" ? Nonlinearity::sine
                            : (shape == "tanh" ? Nonlinearity::tanh
                                               : (shape == "sine_last" ? Nonlinearity::sine_last : Nonlinearity::none));
  }
  return network;
}

const Registration<PlantMake> pair_plant({
    "pair",
    {"Two coupled subsystems", "两个耦合子系统"},
    "seed 002, example 3.1",
    ParamTable({shape_param()}),
    [](const Params& params, double dt) { return plant_of(shaped(pair().network, params), dt); },
});

const Registration<PlantMake> single_plant({
    "single",
    {"The second subsystem alone", "单独的第二个子系统"},
    "seed 002, comparison 2",
    ParamTable({shape_param()}),
    [](const Params& params, double dt) { return plant_of(shaped(single().network, params), dt); },
});

const Registration<PlantMake> areas_plant({
    "areas",
    {"Four areas of a power network", "四区域电力系统"},
    "seed 002, comparison 1",
    ParamTable({
        {.name = "case",
         .type = ParamType::integer,
         .fallback = 1,
         .minimum = 1,
         .maximum = 2,
         .meaning = {"Outputs of areas 2 and 4; in case 2 they violate the matching condition",
                     "区域 2 与 4 的输出；情形 2 不满足匹配条件"}},
        {.name = "topology",
         .type = ParamType::text,
         .fallback = "full",
         .choices = {"full", "ring"},
         .meaning = {"Which areas are coupled", "哪些区域相互耦合"}},
    }),
    [](const Params& params, double dt) {
      const auto outputs = params.integer("case") == 1 ? AreaOutputs::case_1 : AreaOutputs::case_2;
      return plant_of(areas(outputs, params.text("topology") == "full" ? Topology::full : Topology::ring).network, dt);
    },
});

const Registration<PlantMake> own_plant({
    "interconnected",
    {"Interconnected subsystems of one's own", "自定义互联子系统"},
    "seed 002, eq. (1)",
    ParamTable({
        {.name = "subsystems",
         .type = ParamType::object,
         .required = true,
         .meaning = {"By node: matrices A, C and, where there are any, B, D, Dd, F, G, E; alpha, tau, phi",
                     "按节点：矩阵 A、C，以及（如有）B、D、Dd、F、G、E；alpha、tau、phi"}},
        {.name = "couplings",
         .type = ParamType::object,
         .fallback = Json::object(),
         .symbol = "H_ij",
         .meaning = {"\"FROM-TO\": how the state of FROM drives that of TO, n_to x n_from",
                     "\"FROM-TO\"：FROM 的状态如何驱动 TO，n_to × n_from"}},
    }),
    [](const Params& params, double dt) {
      return plant_of(read_network(params.values().at("subsystems"), params.values().at("couplings")), dt);
    },
});

/// y = C x of one subsystem; G f is the plant's to add, since f is a signal of time.
class SubsystemSensor final : public Sensor {
 public:
  SubsystemSensor(const Params& params, const Plant& plant) {
    const auto* own = dynamic_cast<const InterconnectedPlant*>(&plant);
    const int count = own == nullptr ? 0 : own->network().count(), number = params.integer("number");
    if (number > count) {
      throw InputError("/number", count == 0 ? "this plant is not made of subsystems"
                                             : fmt::format("number is {}; the plant has {} subsystems", number, count));
    }
    const Subsystem& s = own->network().subsystems[static_cast<std::size_t>(number - 1)];
    C_ = Eigen::MatrixXd::Zero(s.p(), plant.states());
    C_.middleCols(own->first_state(number - 1), s.n()) = s.C;
    noise_ = params.square("R", s.p());
    for (int c = 1; c <= s.p(); ++c) channels_.push_back({fmt::format("y{}", c), "", 0});
  }

  const std::vector<Component>& channels() const override { return channels_; }
  const Eigen::MatrixXd& noise() const override { return noise_; }
  bool may_be_exact() const override { return true; }
  bool linear() const override { return true; }
  void measure(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Ref<Eigen::VectorXd> z) const override {
    z.noalias() = C_ * x;
  }
  void jacobian(const Eigen::Ref<const Eigen::VectorXd>& /*x*/, Eigen::Ref<Eigen::MatrixXd> H) const override {
    H = C_;
  }

 private:
  Eigen::MatrixXd C_, noise_;
  std::vector<Component> channels_;
};

const Registration<SensorMake> subsystem_sensor({
    "subsystem",
    {"The outputs of a subsystem", "子系统的输出"},
    "seed 002, eq. (1)",
    ParamTable({
        {.name = "number",
         .type = ParamType::integer,
         .minimum = 1,
         .maximum = kMaxSize,
         .required = true,
         .meaning = {"Which subsystem, from 1", "第几个子系统，从 1 起"}},
        {.name = "R",
         .type = ParamType::matrix,
         .fallback = 0,
         .symbol = "R",
         .meaning = {"Covariance of a noise that is held for a tick; the source has none",
                     "在一步内保持的噪声协方差；原文无噪声"}},
    }),
    [](const Params& params, const Plant& plant) -> std::shared_ptr<const Sensor> {
      return std::make_shared<SubsystemSensor>(params, plant);
    },
});

}  // namespace
}  // namespace vigil::observer
