#include "server/campaigns/work.hpp"

#include <utility>

#include "engine/core/input_error.hpp"
#include "server/campaigns/result.hpp"
#include "server/campaigns/sampled_run.hpp"

namespace vigil {
namespace {

constexpr auto kBetweenCommits = std::chrono::milliseconds(250);

/// The trials of a cell that are in the log, merged.
CampaignCell merged(const LogReader& reader, std::int64_t campaign, const CampaignCellRow& row, std::int64_t runs) {
  CampaignCell cell;
  if (row.columns.is_null()) return cell;
  const TrialColumns columns = TrialColumns::from_json(row.columns);
  for (const TrialRow& trial : reader.trials(campaign, {row.cell * runs, (row.cell + 1) * runs - 1}))
    cell.add(trial_of(trial, columns));
  cell.load(row.accumulators);
  cell.set_design(row.design);
  return cell;
}

}  // namespace

TrialResult trial_of(const TrialRow& row, const TrialColumns& columns) {
  TrialResult trial = columns.decode(row.numbers);
  trial.seed = row.seed;
  trial.ticks = row.ticks;
  trial.error = row.error;
  trial.faults = faults_of(row.faults);
  for (const Json& warning : row.warnings) trial.warnings.push_back(warning);
  return trial;
}

Json cell_result(const LogReader& reader, std::int64_t campaign, std::int64_t cell, std::int64_t runs) {
  const auto row = reader.campaign_cell(campaign, cell);
  if (!row || !row->result.is_null()) return row ? row->result : Json();
  const CampaignCell part = merged(reader, campaign, *row, runs);
  return part.trials() == 0 ? Json() : part.result();
}

CampaignWork::CampaignWork(LogWriter& log, const LogReader& reader, std::int64_t id, CampaignPlan plan, bool samples)
    : log_(log), id_(id), samples_(samples), plan_(std::move(plan)) {
  const auto row = reader.campaign(id);
  if (!row) throw LogError(LogError::Kind::missing, "There is no campaign " + std::to_string(id) + ".");
  plan_.first = row->done;
  if (row->done % plan_.runs == 0) return;
  const auto cell = reader.campaign_cell(id, row->done / plan_.runs);
  if (!cell) throw std::runtime_error("A point of campaign " + std::to_string(id) + " is missing in the log.");
  cell_ = merged(reader, id, *cell, plan_.runs);
  columns_ = TrialColumns::from_json(cell->columns);
}

bool CampaignWork::run(Crew& crew, const std::atomic<bool>& stop, const Each& each) {
  plan_.trial = [&](std::int64_t index) { return make_trial(index, stop); };
  committed_ = Clock::now();
  std::int64_t done = plan_.first;
  crew.run(plan_, stop, [&](std::int64_t index, const TrialResult& trial) {
    take(index, trial);
    done = index + 1;
    if (each) each(done, trial);
  });
  settle();
  commit();
  settle();
  return done == plan_.trials();
}

TrialResult CampaignWork::make_trial(std::int64_t index, const std::atomic<bool>& stop) {
  if (!samples_) return plain_trial(plan_, index, stop);
  const CampaignPoint& point = plan_.points[static_cast<std::size_t>(index / plan_.runs)];
  try {
    return kept_trial(point, index, stop);
  } catch (const InputError& error) {
    return failed_trial(plan_, index, error.what());
  }
}

TrialResult CampaignWork::kept_trial(const CampaignPoint& point, std::int64_t index, const std::atomic<bool>& stop) {
  Run run(point.scenario, {plan_.seed_of(index), plan_.trace, {}, point.designs});
  prepare_trial(run);
  SampledRun kept(log_, id_, index, plan_, run);
  {
    const std::lock_guard lock(mutex_);
    runs_[index] = kept.id();
  }
  while (!run.done()) {
    if (stop) throw TrialGivenUp();
    run.step(kept);
  }
  kept.finish(run);
  return take_trial(run);
}

TrialRow CampaignWork::row_of(std::int64_t index, const TrialResult& trial) {
  TrialRow row;
  row.index = index;
  row.seed = trial.seed;
  row.state = trial_state(trial);
  row.numbers = columns_.encode(trial);
  row.ticks = trial.ticks;
  row.error = trial.error;
  for (const FaultCount& fault : trial.faults) row.faults.push_back(to_json(fault));
  for (const std::string& warning : trial.warnings) row.warnings.push_back(warning);
  const std::lock_guard lock(mutex_);
  if (const auto kept = runs_.find(index); kept != runs_.end()) {
    row.run = kept->second;
    runs_.erase(kept);
  }
  return row;
}

void CampaignWork::take(std::int64_t index, const TrialResult& trial) {
  cell_.add(trial);
  batch_.trials.push_back(row_of(index, trial));
  if ((index + 1) % plan_.runs == 0) close_cell(index / plan_.runs);
  if (trial.more) return;  // what is committed must be whole
  const bool busy = committing_.valid() && committing_.wait_for(std::chrono::seconds(0)) != std::future_status::ready;
  if (busy || Clock::now() - committed_ < kBetweenCommits) return;
  settle();
  commit();
}

void CampaignWork::close_cell(std::int64_t cell) {
  CampaignCellRow row;
  row.cell = cell;
  row.design = cell_.design();
  row.columns = columns_.to_json();
  row.result = cell_.result();
  batch_.cells.push_back(std::move(row));
  cell_ = {};
  columns_ = {};
}

/// Hands the batch to the log without waiting for it.
void CampaignWork::commit() {
  committed_ = Clock::now();
  if (batch_.trials.empty()) return;
  if (cell_.trials() > 0) {
    CampaignCellRow row;
    row.cell = batch_.trials.back().index / plan_.runs;
    row.design = cell_.design();
    row.columns = columns_.to_json();
    row.accumulators = cell_.save();
    batch_.cells.push_back(std::move(row));
  }
  committing_ = log_.add_trials(id_, std::exchange(batch_, {}));
}

void CampaignWork::settle() {
  if (committing_.valid()) committing_.get();
}

}  // namespace vigil
