#include "engine/adversary/attack.hpp"

#include <algorithm>
#include <limits>

namespace vigil {

void LinkEffects::resize(int message, int links) {
  state.assign(static_cast<std::size_t>(links), LinkState::clean);
  injected = Eigen::MatrixXd::Zero(message, links);
  strength = Eigen::VectorXd::Constant(links, std::numeric_limits<double>::quiet_NaN());
  playback.assign(static_cast<std::size_t>(links), {});
  overheard.assign(static_cast<std::size_t>(links), 0);
}

void LinkEffects::clear() {
  std::fill(state.begin(), state.end(), LinkState::clean);
  injected.setZero();
  strength.setConstant(std::numeric_limits<double>::quiet_NaN());
  std::fill(playback.begin(), playback.end(), Playback{});
  std::fill(overheard.begin(), overheard.end(), 0);
}

void LinkEffects::jam(int link) {
  state[static_cast<std::size_t>(link)] = LinkState::dos;
  injected.col(link).setZero();
  playback[static_cast<std::size_t>(link)] = {};
}

void LinkEffects::play(int link, const Playback& record) {
  LinkState& mine = state[static_cast<std::size_t>(link)];
  if (mine == LinkState::dos) return;
  mine = LinkState::replay;
  injected.col(link).setZero();
  playback[static_cast<std::size_t>(link)] = record;
}

void LinkEffects::inject(int link, const Eigen::Ref<const Eigen::VectorXd>& added, double scale) {
  LinkState& mine = state[static_cast<std::size_t>(link)];
  if (mine == LinkState::dos) return;
  if (mine != LinkState::replay) mine = LinkState::fdi;
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
  playback.clear();
  for (const int size : channels) playback.emplace_back(static_cast<std::size_t>(size));
  shaping.assign(channels.size(), {});
  lost.clear();
  for (const int size : channels) lost.emplace_back(static_cast<std::size_t>(size), 0);
}

void SensorEffects::clear() {
  for (Eigen::VectorXd& value : injected) value.setZero();
  std::fill(state.begin(), state.end(), SensorState::clean);
  for (auto& channels : playback) std::fill(channels.begin(), channels.end(), Playback{});
  std::fill(shaping.begin(), shaping.end(), Shaping{});
  for (auto& channels : lost) std::fill(channels.begin(), channels.end(), 0);
}

void SensorEffects::jam(const SensorPlace& place) {
  const auto node = static_cast<std::size_t>(place.node);
  state[node] = SensorState::dos;
  for (std::size_t c = 0; c < lost[node].size(); ++c) {
    if (place.channel < 0 || place.channel == static_cast<int>(c)) lost[node][c] = 1;
  }
}

void SensorEffects::move(int node, const Eigen::VectorXd& by, double share) {
  Shaping& mine = shaping[static_cast<std::size_t>(node)];
  mine.moved = &by;
  mine.share = share;
  state[static_cast<std::size_t>(node)] = SensorState::fdi;
}

void SensorEffects::aim(int node, const Eigen::VectorXd& direction, double budget) {
  Shaping& mine = shaping[static_cast<std::size_t>(node)];
  mine.direction = &direction;
  mine.budget = budget;
  state[static_cast<std::size_t>(node)] = SensorState::fdi;
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

void SensorEffects::play(const SensorPlace& place, const Playback& record) {
  const auto node = static_cast<std::size_t>(place.node);
  state[node] = SensorState::replay;
  for (std::size_t c = 0; c < playback[node].size(); ++c) {
    if (place.channel >= 0 && place.channel != static_cast<int>(c)) continue;
    playback[node][c] = record;
    injected[node][static_cast<Eigen::Index>(c)] = 0;
  }
}

bool SensorEffects::plays(int node) const {
  const auto& channels = playback[static_cast<std::size_t>(node)];
  return std::any_of(channels.begin(), channels.end(), [](const Playback& one) { return one.source >= 0; });
}

void ActuatorEffects::clear() {
  pushes.clear();
  stops.clear();
}

void Attack::reach(std::int64_t k, std::span<const ActuatorPlace> places, ActuatorEffects& effects) const {
  for (const ActuatorPlace& place : places) effects.pushes.push_back({this, place, k});
}

const char* word(ChannelKind kind) {
  static constexpr const char* kWords[] = {"link", "sensor", "actuator"};
  return kWords[static_cast<std::size_t>(kind)];
}

}  // namespace vigil
