/// Protections watched from outside: those who listen to a lane, what their errors are against the exact traces, and
/// the privacy loss of what encode() drew.
#pragma once

#include <map>
#include <utility>

#include "tests/engine/methods/privacy/fusion_rig.hpp"

namespace vigil::rig {

/// Draws the start in the stationary error law, of a plant that may have no law of its own: it begins at the prior.
inline Eigen::VectorXd lawful_start(Knowledge& known, std::uint64_t seed) {
  const FusionModel model = privacy::fusion_model(known);
  if (privacy::state_covariance(model)) return start(known, seed);
  Eigen::VectorXd draw(model.stacked());
  Draws(seed, "initial").normals(0, draw);
  const Eigen::VectorXd errors = symmetric_root(privacy::stationary_filters(model)->P) * draw;
  known.estimates =
      (known.prior.replicate(known.estimates.cols(), 1) - errors).reshaped(model.states(), known.estimates.cols());
  return known.prior;
}

/// Everybody who may listen to a lane.
class Audience {
 public:
  explicit Audience(const privacy::Protection& protection) {
    for (const std::string& variant : protection.eavesdroppers()) members_[variant] = protection.eavesdropper(variant);
  }
  void listen(const privacy::PublicTick& tick, const Eigen::MatrixXd& messages, const std::vector<char>& heard,
              const Eigen::VectorXd* published) {
    Eigen::MatrixXd seen = messages;
    for (std::size_t i = 0; i < heard.size(); ++i) {
      if (!heard[i]) seen.col(static_cast<Eigen::Index>(i)).setConstant(std::nan(""));
    }
    for (auto& [variant, member] : members_) {
      if (published != nullptr) member->see(tick, *published);
      member->listen(tick, seen, heard);
    }
  }
  const std::map<std::string, std::unique_ptr<privacy::Eavesdropper>>& members() const { return members_; }

 private:
  std::map<std::string, std::unique_ptr<privacy::Eavesdropper>> members_;
};

inline std::vector<char> audible(const privacy::Protection& protection, std::size_t sensors) {
  std::vector<char> heard;
  for (std::size_t i = 0; i < sensors; ++i) heard.push_back(protection.audible(static_cast<int>(i)) ? 1 : 0);
  return heard;
}

/// Squared error less the trace of its covariance, over many runs of the stationary lane: of "user" and every variant
/// that has a trace, by name and tick.
using Gaps = std::map<std::pair<std::string, std::int64_t>, Sample>;
inline Gaps gaps_of(const FusionModel& model, const std::string& id, const Json& params,
                    const std::vector<std::int64_t>& ticks, int runs) {
  Gaps gaps;
  for (int run = 1; run <= runs; ++run) {
    const auto seed = static_cast<std::uint64_t>(run);
    Knowledge known = knowledge_of_model(model);
    known.seed = seed;
    const Eigen::VectorXd truth = lawful_start(known, seed);
    known.protection = protect(known, id, params);
    const auto lane = fusion_lane(known, "stationary");
    Audience audience(lane->fusion()->protection());
    drive(*lane, known, truth, ticks.back(), seed, {},
          [&](std::int64_t k, const Eigen::VectorXd& x, const Method& method, const Eigen::MatrixXd& sent) {
            const FusionMethod& fusion = *method.fusion();
            const privacy::Protection& protection = fusion.protection();
            audience.listen(fusion.public_tick(), sent, audible(protection, known.sensors.size()),
                            protection.published());
            if (std::find(ticks.begin(), ticks.end(), k) == ticks.end()) return;
            const auto add = [&](const std::string& name, const Eigen::VectorXd& estimate, double trace) {
              if (std::isfinite(trace)) gaps[{name, k}].add((x - estimate).squaredNorm() - trace);
            };
            add("user", mean(method, static_cast<int>(known.sensors.size()), model.states()),
                fusion.legitimate_trace());
            for (const auto& [variant, member] : audience.members())
              add(variant, member->estimate(), protection.eavesdropper_trace(fusion.public_tick(), variant));
          });
  }
  return gaps;
}

inline void expect_no_gap(const Gaps& gaps) {
  for (const auto& [key, gap] : gaps) EXPECT_NEAR(gap.mean(), 0, 4 * gap.error()) << key.first << " at " << key.second;
}

/// What an audience has to go by: a run as recorded outside, some messages of it not overheard.
struct Recording {
  std::vector<privacy::PublicTick> ticks;
  std::vector<Eigen::MatrixXd> messages;
  std::vector<std::vector<char>> heard;
  std::vector<Eigen::VectorXd> published;
  std::map<std::string, std::vector<Eigen::VectorXd>> estimates;  ///< what the lane's own audience made of it
};

/// Replays it to an audience and expects the same estimates, to the last bit.
inline void expect_same(const Recording& run, Audience audience) {
  for (std::size_t k = 0; k < run.ticks.size(); ++k) {
    audience.listen(run.ticks[k], run.messages[k], run.heard[k],
                    run.published[k].size() > 0 ? &run.published[k] : nullptr);
    for (const auto& [variant, member] : audience.members())
      EXPECT_EQ(member->estimate(), run.estimates.at(variant)[k]) << variant << " at " << k;
  }
}

/// Each member's estimate is a function of what it heard, what is public and the code: one made from another seed, one
/// made from a protection whose secrets are all drawn, and those of the run agree.
inline void expect_public_knowledge_only(const FusionModel& model, const std::string& id, const Json& params) {
  Knowledge known = knowledge_of_model(model);
  known.seed = 3;
  const Eigen::VectorXd truth = lawful_start(known, 3);
  known.protection = protect(known, id, params);
  const auto lane = fusion_lane(known, "stationary");
  Audience audience(lane->fusion()->protection());
  Recording run;
  drive(*lane, known, truth, 80, 3, {},
        [&](std::int64_t k, const Eigen::VectorXd&, const Method& method, const Eigen::MatrixXd& sent) {
          const FusionMethod& fusion = *method.fusion();
          const privacy::Protection& protection = fusion.protection();
          auto heard = audible(protection, known.sensors.size());
          if (k % 17 == 11) heard[0] = 0;
          const Eigen::VectorXd* published = protection.published();
          run.ticks.push_back(fusion.public_tick());
          run.messages.push_back(sent);
          run.heard.push_back(heard);
          run.published.push_back(published != nullptr ? *published : Eigen::VectorXd());
          audience.listen(fusion.public_tick(), sent, heard, published);
          for (const auto& [variant, member] : audience.members()) run.estimates[variant].push_back(member->estimate());
        });
  ASSERT_EQ(run.ticks.size(), 81U);
  expect_same(run, Audience(lane->fusion()->protection()));
  Knowledge other = knowledge_of_model(model);
  other.seed = 99;
  expect_same(run, Audience(*protect(other, id, params)));
}

}  // namespace vigil::rig
