#include "server/campaigns/results.hpp"

#include <algorithm>
#include <utility>

#include "server/campaigns/work.hpp"

namespace vigil {
namespace {

constexpr std::size_t kMostParts = 8;

std::int64_t runs_of(const CampaignRow& campaign) { return campaign.request.value("runs", std::int64_t{1}); }

}  // namespace

CampaignResults::Part& CampaignResults::part(std::int64_t campaign, std::int64_t cell, std::int64_t runs) {
  const auto same = [&](const Part& one) { return one.campaign == campaign && one.cell == cell; };
  const auto place = std::find_if(parts_.begin(), parts_.end(), same);
  if (place != parts_.end()) {
    parts_.splice(parts_.begin(), parts_, place);
  } else {
    Part& fresh = parts_.emplace_front();
    fresh.campaign = campaign;
    fresh.cell = cell;
    fresh.next = cell * runs;
    if (parts_.size() > kMostParts) parts_.pop_back();
  }
  return parts_.front();
}

/// False where the cell has no trial, or all of them: then the log has its result.
bool CampaignResults::catch_up(Part& part, std::int64_t runs) {
  const auto now = reader_.campaign_part(part.campaign, part.cell, {part.next, (part.cell + 1) * runs - 1});
  if (!now || now->cell.columns.is_null() || !now->cell.result.is_null()) return false;
  if (now->trials.empty()) return part.merged.trials() > 0;
  const TrialColumns columns = TrialColumns::from_json(now->cell.columns);
  for (const TrialRow& row : now->trials) {
    part.merged.add(trial_of(row, columns));
    ++part.states[row.state];
  }
  part.merged.load(now->cell.accumulators);
  part.merged.set_design(now->cell.design);
  part.next = now->trials.back().index + 1;
  part.summary.reset();
  part.result = nullptr;
  return true;
}

CellSummary CampaignResults::summary_of(const Part& part) {
  const CampaignOutcome outcome = part.merged.outcome(Json::object());
  CellSummary summary;
  for (const char* state : {"finished", "stopped", "failed"}) {
    const auto place = part.states.find(state);
    summary.trials[state] = place == part.states.end() ? 0 : place->second;
  }
  summary.ticks = outcome.ticks;
  summary.warnings = outcome.warnings;
  for (const MetricSummary& m : outcome.metrics) {
    summary.rows.push_back(
        {m.key.lane,
         m.key.node,
         m.key.name,
         m.key.variant,
         {m.mean, m.se, m.median, m.min, m.max, m.q05, m.q25, m.q75, m.q95, static_cast<double>(m.n)}});
  }
  return summary;
}

Json CampaignResults::result(const CampaignRow& campaign, std::int64_t cell) {
  const std::int64_t runs = runs_of(campaign);
  if (cell * runs >= campaign.done) return {};
  if ((cell + 1) * runs > campaign.done) {
    const std::lock_guard lock(mutex_);
    Part& now = part(campaign.id, cell, runs);
    if (catch_up(now, runs)) {
      if (now.result.is_null()) now.result = now.merged.result();
      return now.result;
    }
    parts_.pop_front();
  }
  const auto row = reader_.campaign_cell(campaign.id, cell);
  return row ? row->result : Json();
}

std::vector<SummaryRow> CampaignResults::summaries(const CampaignRow& campaign, std::int64_t first) {
  std::vector<SummaryRow> rows = reader_.campaign_summaries(campaign.id, first);
  const std::int64_t runs = runs_of(campaign);
  const std::int64_t next = std::max(first, rows.empty() ? first : rows.back().cell + 1);
  // What is under way stands right behind those that are whole; asked for later ones, it may not be among them.
  if (next * runs >= campaign.done) return rows;
  const std::lock_guard lock(mutex_);
  Part& now = part(campaign.id, next, runs);
  if (!catch_up(now, runs)) {
    parts_.pop_front();
    return rows;
  }
  if (!now.summary) now.summary = summary_of(now);
  rows.push_back({next, *now.summary});
  return rows;
}

}  // namespace vigil
