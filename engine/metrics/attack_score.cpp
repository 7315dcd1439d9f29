#include "engine/metrics/attack_score.hpp"

namespace vigil {

AttackScore::AttackScore(const std::vector<int>& channels, int window, int outputs) : window_(std::max(window, 1)) {
  for (int o = 0; o < std::min(outputs, static_cast<int>(channels.size())); ++o) {
    nodes_.push_back({Eigen::MatrixXd::Zero(channels[static_cast<std::size_t>(o)], window_),
                      std::vector<SensorState>(static_cast<std::size_t>(window_), SensorState::clean)});
  }
}

void AttackScore::note(const std::vector<Eigen::VectorXd>& injected, const std::vector<SensorState>& states) {
  const auto slot = static_cast<Eigen::Index>(ticks_ % window_);
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    nodes_[i].injected.col(slot) = injected[i];
    nodes_[i].states[static_cast<std::size_t>(slot)] = states[i];
  }
  ++ticks_;
}

/// The slot of the tick `back` ticks before the newest.
int AttackScore::place(int back, int window) const { return static_cast<int>((ticks_ - 1 - back + window) % window); }

void AttackScore::judge(int output, const Reconstruction& found, int choice) {
  if (static_cast<std::size_t>(output) >= nodes_.size()) return;
  Node& node = nodes_[static_cast<std::size_t>(output)];
  if (choice >= 0) {
    const auto& states = nodes_[static_cast<std::size_t>(choice)].states;
    ++node.chosen;
    if (states[static_cast<std::size_t>(place(0, window_))] != SensorState::clean) ++node.chosen_attacked;
  }
  if (found.entries != nullptr && found.window <= window_ && ticks_ >= found.window) judge_window(node, found);
}

/// Counts only windows that are clean throughout or attacked throughout in one way.
void AttackScore::judge_window(const Node& node, const Reconstruction& found) {
  const SensorState type = node.states[static_cast<std::size_t>(place(0, window_))];
  for (int back = 1; back < found.window; ++back) {
    if (node.states[static_cast<std::size_t>(place(back, window_))] != type) return;
  }
  Tally window;
  for (int j = 0; j < found.window; ++j) {
    const int slot = place(found.window - 1 - j, window_);
    for (int c = 0; c < found.channels; ++c) {
      const bool is = node.injected(c, slot) != 0, said = found.entries[j * found.channels + c] != 0;
      window.entries += is ? 1 : 0;
      window.hits += is && said ? 1 : 0;
      window.false_entries += !is && said ? 1 : 0;
    }
  }
  if (type == SensorState::clean) {
    ++clean_windows_;
    clean_alarms_ += window.false_entries > 0 ? 1 : 0;
    return;
  }
  Tally& tally = of_type_[static_cast<std::size_t>(type)];
  ++tally.windows;
  tally.exact += window.hits == window.entries && window.false_entries == 0 ? 1 : 0;
  tally.entries += window.entries;
  tally.hits += window.hits;
  tally.false_entries += window.false_entries;
}

void AttackScore::append_metrics(const std::string& lane, const std::vector<std::string>& outputs,
                                 std::vector<MetricValue>& metrics) const {
  const auto share = [](std::int64_t part, std::int64_t whole) {
    return static_cast<double>(part) / static_cast<double>(whole);
  };
  const auto add = [&](const char* name, const std::string& variant, std::int64_t part, std::int64_t whole) {
    if (whole > 0) metrics.push_back({lane, "", name, variant, share(part, whole), false});
  };
  for (std::size_t o = 0; o < nodes_.size(); ++o) {
    const Node& node = nodes_[o];
    if (node.chosen > 0)
      metrics.push_back(
          {lane, outputs[o], "choice_attacked_share", "", share(node.chosen_attacked, node.chosen), false});
  }
  add("alarm_rate_clean", "", clean_alarms_, clean_windows_);
  for (int type = 1; type < kStates; ++type) {
    const Tally& tally = of_type_[type];
    const std::string variant = word(static_cast<SensorState>(type));
    add("omp_exact", variant, tally.exact, tally.windows);
    add("omp_hit_rate", variant, tally.hits, tally.entries);
    add("omp_false_entries", variant, tally.false_entries, tally.windows);
  }
}

}  // namespace vigil
