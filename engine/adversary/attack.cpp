#include "engine/adversary/attack.hpp"

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

void LinkEffects::inject(int link, const Eigen::Ref<const Eigen::VectorXd>& added) {
  LinkState& mine = state[static_cast<std::size_t>(link)];
  if (mine == LinkState::dos) return;
  mine = LinkState::fdi;
  injected.col(link) += added;
}

}  // namespace vigil
