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

const char* word(SensorState state) {
  static constexpr const char* kWords[] = {"clean", "DoS", "FDI", "replay", "I", "II", "R"};
  return kWords[static_cast<std::size_t>(state)];
}

void SensorEffects::resize(const std::vector<int>& channels) {
  injected.clear();
  for (const int size : channels) injected.emplace_back(Eigen::VectorXd::Zero(size));
  state.assign(channels.size(), SensorState::clean);
  playback.assign(channels.size(), {});
}

void SensorEffects::clear() {
  for (Eigen::VectorXd& value : injected) value.setZero();
  std::fill(state.begin(), state.end(), SensorState::clean);
  std::fill(playback.begin(), playback.end(), Playback{});
}

void SensorEffects::add(const SensorPlace& place, const Eigen::Ref<const Eigen::VectorXd>& added, SensorState as) {
  const auto node = static_cast<std::size_t>(place.node);
  state[node] = as;
  if (place.channel >= 0) {
    injected[node][place.channel] += added[0];
  } else {
    injected[node] += added;
  }
}

void SensorEffects::set(int node, const Eigen::Ref<const Eigen::VectorXd>& value, SensorState as) {
  injected[static_cast<std::size_t>(node)] = value;
  state[static_cast<std::size_t>(node)] = as;
}

void SensorEffects::play(int node, const Playback& record) {
  const auto i = static_cast<std::size_t>(node);
  playback[i] = record;
  state[i] = SensorState::replay;
  if (record.channel >= 0) {
    injected[i][record.channel] = 0;
  } else {
    injected[i].setZero();
  }
}

}  // namespace vigil
