/// Interconnected subsystems as a plant: one node a subsystem. Seed 002, eq. (1).
#pragma once

#include <string>
#include <vector>

#include "engine/world/continuous.hpp"
#include "engine/world/interconnected/network.hpp"

namespace vigil::observer {

/// States "x<i>_<c>" (subsystem i, state c, both from 1), inputs "u<i>_<c>".
class InterconnectedPlant final : public ContinuousPlant {
 public:
  /// Throws InputError relative to the plant's params where check() finds something.
  InterconnectedPlant(Network network, double dt);

  const Network& network() const { return network_; }
  int first_state(int subsystem) const { return first_[static_cast<std::size_t>(subsystem)]; }

  const std::vector<Component>& state() const override { return state_; }
  const std::vector<Component>& input() const override { return input_; }
  const std::vector<ErrorGroup>& errors() const override { return errors_; }
  /// A tick under constant u, undisturbed, by one step of RK4 (as many as its poles need).
  void advance(const Eigen::Ref<const Eigen::VectorXd>& x, const Eigen::Ref<const Eigen::VectorXd>& u,
               Eigen::Ref<Eigen::VectorXd> next) const override;
  /// Of that, by central differences.
  void jacobian(const Eigen::Ref<const Eigen::VectorXd>& x, const Eigen::Ref<const Eigen::VectorXd>& u,
                Eigen::Ref<Eigen::MatrixXd> F) const override;

  const std::vector<DrivePorts>& ports() const override { return ports_; }
  int outputs() const override { return static_cast<int>(output_x_.rows()); }
  void slope(const Eigen::Ref<const Eigen::VectorXd>& x, const Eigen::Ref<const Eigen::VectorXd>& v,
             Eigen::Ref<Eigen::VectorXd> dx) const override;
  void output(const Eigen::Ref<const Eigen::VectorXd>& x, const Eigen::Ref<const Eigen::VectorXd>& v,
              Eigen::Ref<Eigen::VectorXd> y) const override;
  LinearModel linear_part() const override;
  double fastest() const override { return fastest_; }
  void check_nodes(const std::vector<std::string>& nodes,
                   const std::vector<std::shared_ptr<const Sensor>>& sensors) const override;

 private:
  Network network_;
  double dt_;
  std::vector<int> first_;
  std::vector<Component> state_, input_;
  std::vector<ErrorGroup> errors_;
  std::vector<DrivePorts> ports_;
  Eigen::MatrixXd slope_x_, slope_v_;    ///< the linear part
  Eigen::MatrixXd output_x_, output_v_;  ///< y
  double fastest_ = 0;
};

/// {"<id>":{"A":…,"C":…,…}} and {"<from>-<to>":H}. Throws InputError under /subsystems and /couplings.
Network read_network(const Json& subsystems, const Json& couplings);
/// What read_network reads: {"subsystems","couplings"}.
Json write_network(const Network& network);

}  // namespace vigil::observer
