#include "server/runs/campaign_runner.hpp"

#include <algorithm>

#include "engine/core/input_error.hpp"
#include "server/crew/threads.hpp"

namespace vigil {
namespace {

void add_fault(std::vector<CampaignFault>& sums, const FaultCount& fault) {
  for (CampaignFault& sum : sums) {
    if (sum.fault.lane != fault.lane || sum.fault.node != fault.node || sum.fault.code != fault.code) continue;
    sum.fault.first = std::min(sum.fault.first, fault.first);
    sum.fault.last = std::max(sum.fault.last, fault.last);
    sum.fault.count += fault.count;
    sum.fault.stopped = sum.fault.stopped || fault.stopped;
    ++sum.runs;
    return;
  }
  sums.push_back({fault, 1});
}

class NullSink final : public Sink {
 public:
  void frame(const Frame& /*frame*/) override {}
  void mark(const Mark& /*mark*/) override {}
};

template <class Rows>
Json list_json(const Rows& rows) {
  Json list = Json::array();
  for (const auto& row : rows) list.push_back(to_json(row));
  return list;
}

}  // namespace

const char* trial_state(const TrialResult& trial) {
  if (!trial.error.empty()) return "failed";
  const bool stopped =
      std::any_of(trial.faults.begin(), trial.faults.end(), [](const FaultCount& fault) { return fault.stopped; });
  return stopped ? "stopped" : "finished";
}

TrialResult failed_trial(const CampaignPlan& plan, std::int64_t index, const std::string& error) {
  TrialResult failed;
  failed.seed = plan.seed_of(index);
  failed.error = error;
  return failed;
}

TrialResult plain_trial(const CampaignPlan& plan, std::int64_t index, const std::atomic<bool>& stop) {
  const CampaignPoint& point = plan.points[static_cast<std::size_t>(index / plan.runs)];
  try {
    Run run(point.scenario, {plan.seed_of(index), plan.trace, {}, point.designs});
    prepare_trial(run);
    NullSink sink;
    while (!run.done()) {
      if (stop) throw TrialGivenUp();
      run.step(sink);
    }
    return take_trial(run);
  } catch (const InputError& error) {
    return failed_trial(plan, index, error.what());
  }
}

void CampaignCell::add(const TrialResult& trial) {
  table_.add(trial);
  const std::string_view state = trial_state(trial);
  ++(state == "failed" ? failed_ : state == "stopped" ? stopped_ : finished_);
  if (sums_.design.is_null()) sums_.design = trial.design;
  for (const FaultCount& fault : trial.faults) add_fault(sums_.faults, fault);
  for (const std::string& warning : trial.warnings) {
    const auto& known = sums_.warnings;
    if (std::find(known.begin(), known.end(), warning) == known.end()) sums_.warnings.push_back(warning);
  }
  sums_.ticks += trial.ticks;
}

CampaignOutcome CampaignCell::outcome(Json sweep) const {
  CampaignOutcome outcome = sums_;
  outcome.sweep = std::move(sweep);
  outcome.metrics = table_.summary();
  return outcome;
}

Json CampaignCell::result() const {
  Json faults = Json::array();
  for (const CampaignFault& fault : sums_.faults) {
    faults.push_back(to_json(fault.fault));
    faults.back()["runs"] = fault.runs;
  }
  return {{"trials", {{"finished", finished_}, {"stopped", stopped_}, {"failed", failed_}}},
          {"ticks", sums_.ticks},
          {"metrics", list_json(table_.summary())},
          {"paired", list_json(table_.paired())},
          {"detection", list_json(table_.detection())},
          {"faults", std::move(faults)},
          {"warnings", sums_.warnings},
          {"design", sums_.design}};
}

std::vector<CampaignPoint> make_grid(const Scenario& base,
                                     const std::vector<std::pair<std::string, std::vector<Json>>>& sweeps) {
  std::vector<CampaignPoint> points{{Json::object(), base, Json::object()}};
  for (const auto& [path, values] : sweeps) {
    std::vector<CampaignPoint> wider;
    for (const CampaignPoint& point : points) {
      for (const Json& value : values) {
        CampaignPoint next{point.sweep, point.scenario.with(path, value), point.designs};
        next.sweep[path] = value;
        wider.push_back(std::move(next));
      }
    }
    points = std::move(wider);
  }
  return points;
}

std::vector<CampaignOutcome> run_campaign(const CampaignPlan& plan, const std::atomic<bool>& stop,
                                          const std::function<void(std::int64_t, const TrialResult&)>& each) {
  std::vector<CampaignOutcome> outcomes;
  CampaignCell cell;
  const auto close = [&] {
    outcomes.push_back(cell.outcome(plan.points[outcomes.size()].sweep));
    cell = {};
  };
  ThreadCrew().run(plan, stop, [&](std::int64_t index, const TrialResult& trial) {
    cell.add(trial);
    if (each) each(index, trial);
    if ((index + 1) % plan.runs == 0) close();
  });
  if (cell.trials() > 0) close();
  return outcomes;
}

}  // namespace vigil
