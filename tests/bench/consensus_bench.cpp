/// Network steps a second of the consensus lane alone (predict, send, deliver, update; guard `clip` included) on
/// prerecorded readings and links, beside a bare fixed-size Eigen loop of the same algebra. Thread CPU time, best of
/// seven, interleaved. Then whole runs of the preset, for information.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>

#include "engine/methods/consensus/filter.hpp"
#include "engine/run/campaign.hpp"
#include "engine/run/fault_table.hpp"
#include "tests/bench/yardsticks/consensus_fixed.hpp"
#include "tests/engine/methods/rig.hpp"

namespace {

using vigil::Delivery;
using vigil::Knowledge;
using vigil::LinkState;

constexpr int kSteps = 20'000;
constexpr int kRepeats = 7;
constexpr double kBar = 0.15;

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Calls a second of CPU time of one batch.
template <class Step>
double rate(int steps, Step&& step) {
  const double before = cpu_seconds();
  for (int i = 0; i < steps; ++i) step();
  return steps / (cpu_seconds() - before);
}

/// The lane of preset `consensus` as a run drives it, without world, scores and frames. The plant goes round its
/// circle, so the ring can be played for ever.
class Lane {
 public:
  Lane() : known_(vigil::rig::knowledge_of(vigil::Scenario::preset("consensus"))) {
    vigil::rig::set_rates(known_, {0.2, 0.2, 1.5 * std::sqrt(2.0)});
    filter_ = vigil::consensus::make_filter(vigil::rig::completed("consensus_ekf"), known_);
    Eigen::VectorXd truth = Eigen::Vector3d(150, 70, 0), next(3);
    for (int k = 0; k < yardstick::kRing; ++k) {
      known_.plant->advance(truth, none_, next);
      truth = next;
      readings_.push_back(vigil::rig::readings_at(known_, truth, 1, k));
      links_.push_back(vigil::rig::attacked(known_, 1, k, 0.2, 0.2, 1.5));
    }
    inbox_.resize(known_.graph.links().size());
    for (Delivery& delivery : inbox_) delivery.payload = Eigen::VectorXd::Zero(3);
    sent_ = Eigen::MatrixXd::Zero(3, known_.graph.nodes());
    start_ = filter_->clone();
  }

  void step() {
    const auto k = static_cast<std::size_t>(next_);
    if (next_ == 0) filter_ = start_->clone();
    next_ = (next_ + 1) % yardstick::kRing;
    faults_.begin_tick(++tick_);
    filter_->predict(none_, faults_);
    for (int node = 0; node < known_.graph.nodes(); ++node) filter_->send(node, sent_.col(node));
    for (std::size_t l = 0; l < inbox_.size(); ++l) {
      const LinkState state = links_[k].state[l];
      inbox_[l].lost = state == LinkState::dos;
      inbox_[l].flagged = state == LinkState::fdi;
      inbox_[l].payload = sent_.col(known_.graph.links()[l].from);
      if (inbox_[l].flagged) inbox_[l].payload += links_[k].injected.col(static_cast<Eigen::Index>(l));
    }
    filter_->update(readings_[k], inbox_, faults_);
  }

  bool sound() const { return !faults_.stopped() && std::isfinite(filter_->belief(0).mean[0]); }

 private:
  Knowledge known_;
  Eigen::VectorXd none_{0};
  std::unique_ptr<vigil::Method> filter_, start_;
  std::vector<vigil::Readings> readings_;
  std::vector<vigil::rig::Links> links_;
  std::vector<Delivery> inbox_;
  Eigen::MatrixXd sent_;
  vigil::FaultTable faults_;
  int next_ = 0;
  std::int64_t tick_ = 0;
};

}  // namespace

int main() {
  Lane lane;
  const yardstick::Inputs inputs = yardstick::record(11);
  yardstick::FixedLoop loop(inputs);
  double ours = 0, bare = 0;
  for (int repeat = 0; repeat < kRepeats; ++repeat) {
    ours = std::max(ours, rate(kSteps, [&] { lane.step(); }));
    bare = std::max(bare, rate(4 * kSteps, [&] { loop.step(); }));
  }
  if (!lane.sound() || !std::isfinite(loop.checksum())) {
    std::fprintf(stderr, "the lane or the yardstick diverged: the figures would mean nothing\n");
    return 1;
  }
  std::printf("consensus  ours %.0f network steps/s  yardstick %.0f  ratio %.3f  (bar %.2f)\n", ours, bare, ours / bare,
              kBar);
  const vigil::Scenario preset = vigil::Scenario::preset("consensus");
  std::uint64_t seed = 0;
  const double runs = rate(200, [&] { vigil::run_trial(preset, ++seed); });
  std::printf("consensus  %.0f runs/s of the whole preset (30 steps, seven lanes; 200 runs, set-up included)\n", runs);
  return 0;
}
