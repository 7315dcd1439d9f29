#include "engine/world/interconnected/plant.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>

#include "engine/world/interconnected/rk4.hpp"

namespace vigil::observer {
namespace {

/// Where in the params a problem of check() lies.
std::string pointer_of(const NetworkProblem& problem, const Network& network) {
  if (problem.subsystem < 0) return problem.matrix.starts_with("H") ? "/couplings" : "/subsystems";
  const std::string at = "/subsystems/" + network.subsystems[static_cast<std::size_t>(problem.subsystem)].name;
  if (problem.matrix.starts_with("H")) return "/couplings";
  return problem.matrix.empty() ? at : at + "/" + problem.matrix;
}

void refuse_bad(const Network& network) {
  std::vector<Problem> problems;
  for (const NetworkProblem& problem : check(network))
    problems.push_back({pointer_of(problem, network), problem.reason});
  if (!problems.empty()) throw InputError(std::move(problems));
}

}  // namespace

InterconnectedPlant::InterconnectedPlant(Network network, double dt) : network_(std::move(network)), dt_(dt) {
  refuse_bad(network_);
  errors_ = {{"state", {}, ""}};
  int states = 0, drives = 0, outputs = 0;
  for (int i = 0; i < network_.count(); ++i) {
    const Subsystem& s = network_.subsystems[static_cast<std::size_t>(i)];
    first_.push_back(states);
    for (int c = 1; c <= s.n(); ++c) state_.push_back({fmt::format("x{}_{}", i + 1, c), "", 0});
    for (int c = 1; c <= s.m(); ++c) input_.push_back({fmt::format("u{}_{}", i + 1, c), "", 0});
    ports_.push_back({drives, s.m(), s.q(), s.dd(), s.g()});
    states += s.n();
    drives = ports_.back().end();
    outputs += s.p();
  }
  for (int c = 0; c < states; ++c) errors_[0].components.push_back(c);
  slope_x_ = Eigen::MatrixXd::Zero(states, states);
  slope_v_ = Eigen::MatrixXd::Zero(states, drives);
  output_x_ = Eigen::MatrixXd::Zero(outputs, states);
  output_v_ = Eigen::MatrixXd::Zero(outputs, drives);
  int output = 0;
  for (int i = 0; i < network_.count(); ++i) {
    const Subsystem& s = network_.subsystems[static_cast<std::size_t>(i)];
    const DrivePorts& ports = ports_[static_cast<std::size_t>(i)];
    const int x = first_state(i);
    slope_x_.block(x, x, s.n(), s.n()) = s.A;
    slope_v_.block(x, ports.first, s.n(), s.m()) = s.B;
    slope_v_.block(x, ports.at_w(), s.n(), s.q()) = s.D;
    slope_v_.block(x, ports.at_d(), s.n(), s.dd()) = s.Dd;
    output_x_.block(output, x, s.p(), s.n()) = s.C;
    output_v_.block(output, ports.at_f(), s.p(), s.g()) = s.G;
    output += s.p();
  }
  for (const Coupling& one : network_.couplings) {
    const double alpha = network_.subsystems[static_cast<std::size_t>(one.to)].alpha;
    slope_x_.block(first_state(one.to), first_state(one.from), one.H.rows(), one.H.cols()) -= alpha * one.H;
  }
  fastest_ = Eigen::EigenSolver<Eigen::MatrixXd>(slope_x_, false).eigenvalues().cwiseAbs().maxCoeff();
}

void InterconnectedPlant::slope(const Eigen::Ref<const Eigen::VectorXd>& x, const Eigen::Ref<const Eigen::VectorXd>& v,
                                Eigen::Ref<Eigen::VectorXd> dx) const {
  dx.noalias() = slope_x_ * x;
  dx.noalias() += slope_v_ * v;
  for (int i = 0; i < network_.count(); ++i) {
    const Subsystem& s = network_.subsystems[static_cast<std::size_t>(i)];
    if (s.r() == 0) continue;
    Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxSize, 1> phi(s.r());
    nonlinearity(s, x.segment(first_state(i), s.n()), phi);
    dx.segment(first_state(i), s.n()).noalias() += s.F * phi;
  }
}

void InterconnectedPlant::output(const Eigen::Ref<const Eigen::VectorXd>& x, const Eigen::Ref<const Eigen::VectorXd>& v,
                                 Eigen::Ref<Eigen::VectorXd> y) const {
  y.noalias() = output_x_ * x;
  y.noalias() += output_v_ * v;
}

LinearModel InterconnectedPlant::linear_part() const {
  LinearModel model{slope_x_, Eigen::MatrixXd(states(), inputs())};
  int column = 0;
  for (const DrivePorts& ports : ports_) {
    model.B.middleCols(column, ports.u) = slope_v_.middleCols(ports.first, ports.u);
    column += ports.u;
  }
  return model;
}

void InterconnectedPlant::advance(const Eigen::Ref<const Eigen::VectorXd>& x,
                                  const Eigen::Ref<const Eigen::VectorXd>& u, Eigen::Ref<Eigen::VectorXd> next) const {
  Eigen::VectorXd v = Eigen::VectorXd::Zero(drives()), state = x;
  int entry = 0;
  for (const DrivePorts& ports : ports_) {
    for (int c = 0; c < ports.u; ++c, ++entry) v[ports.first + c] = u.size() > 0 ? u[entry] : 0;
  }
  Rk4 rk4(state.size());
  const int steps = steps_per_tick(dt_, fastest_);
  for (int step = 0; step < steps; ++step) {
    rk4.step(state, 0, dt_ / steps, [&](double, double, const Eigen::VectorXd& at, auto dx) { slope(at, v, dx); });
  }
  next = state;
}

void InterconnectedPlant::jacobian(const Eigen::Ref<const Eigen::VectorXd>& x,
                                   const Eigen::Ref<const Eigen::VectorXd>& u, Eigen::Ref<Eigen::MatrixXd> F) const {
  Eigen::VectorXd moved = x, above(x.size()), below(x.size());
  for (Eigen::Index c = 0; c < x.size(); ++c) {
    const double step = 1e-6 * std::max(1.0, std::abs(x[c]));
    moved[c] = x[c] + step;
    advance(moved, u, above);
    moved[c] = x[c] - step;
    advance(moved, u, below);
    moved[c] = x[c];
    F.col(c) = (above - below) / (2 * step);
  }
}

void InterconnectedPlant::check_nodes(const std::vector<std::string>& nodes,
                                      const std::vector<std::shared_ptr<const Sensor>>& sensors) const {
  const bool as_many = static_cast<int>(nodes.size()) == network_.count();
  for (std::size_t i = 0; as_many && i < nodes.size(); ++i) {
    const Subsystem& s = network_.subsystems[i];
    Eigen::MatrixXd C(sensors[i]->size(), states());
    sensors[i]->jacobian(Eigen::VectorXd::Zero(states()), C);
    const bool fits = s.name == nodes[i] && sensors[i]->size() == s.p() &&
                      C.middleCols(first_state(static_cast<int>(i)), s.n()) == s.C;
    if (!fits) {
      throw InputError(
          "/nodes/" + nodes[i],
          fmt::format("node \"{}\" is not subsystem \"{}\" with its outputs; expected nodes named as the "
                      "subsystems, in their order, each with a sensor of type \"subsystem\" and its number",
                      nodes[i], s.name));
    }
  }
  if (as_many) return;
  throw InputError("/nodes", fmt::format("there are {} nodes and {} subsystems; expected one node a subsystem",
                                         nodes.size(), network_.count()));
}

}  // namespace vigil::observer
