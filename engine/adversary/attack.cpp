#include "engine/adversary/attack.hpp"

#include <algorithm>
#include <limits>

namespace vigil {

void LinkEffects::resize(int message, int links) {
  state.assign(static_cast<std::size_t>(links), LinkState::clean);
  injected = Eigen::MatrixXd::Zero(message, links);
  strength = Eigen::VectorXd::Constant(links, std::numeric_limits<double>::quiet_NaN());
}

void LinkEffects::clear() {
  std::fill(state.begin(), state.end(), LinkState::clean);
  injected.setZero();
  strength.setConstant(std::numeric_limits<double>::quiet_NaN());
}

void LinkEffects::jam(int link) {
  state[static_cast<std::size_t>(link)] = LinkState::dos;
  injected.col(link).setZero();
}

void LinkEffects::inject(int link, const Eigen::Ref<const Eigen::VectorXd>& added, double scale) {
  LinkState& mine = state[static_cast<std::size_t>(link)];
  if (mine == LinkState::dos) return;
  mine = LinkState::fdi;
  injected.col(link) += scale * added;
}

void SensorEffects::resize(const std::vector<int>& channels) {
  injected.clear();
  for (const int size : channels) injected.emplace_back(Eigen::VectorXd::Zero(size));
  kind.assign(channels.size(), 0);
}

void SensorEffects::clear() {
  for (Eigen::VectorXd& value : injected) value.setZero();
  std::fill(kind.begin(), kind.end(), 0);
}

void SensorEffects::add(const SensorPlace& place, const Eigen::Ref<const Eigen::VectorXd>& added, int attack_kind) {
  const auto node = static_cast<std::size_t>(place.node);
  kind[node] = attack_kind;
  if (place.channel >= 0) {
    injected[node][place.channel] += added[0];
  } else {
    injected[node] += added;
  }
}

void SensorEffects::set(int node, const Eigen::Ref<const Eigen::VectorXd>& value, int attack_kind) {
  injected[static_cast<std::size_t>(node)] = value;
  kind[static_cast<std::size_t>(node)] = attack_kind;
}

}  // namespace vigil
