/// LogReader's campaigns, their cells and trials.
#include <bit>

#include "db/chunk.hpp"
#include "db/reader_state.hpp"

namespace vigil {
namespace {

const std::string kCampaignColumns =
    "SELECT id,state,request,result,trials,created,ended,error,"
    "(SELECT coalesce(max(position)+1,0) FROM campaign_trial WHERE campaign=campaign.id),"
    "(SELECT count(*) FROM campaign_trial WHERE campaign=campaign.id AND state<>'finished') FROM campaign ";

CampaignRow campaign_row(const Statement& query) {
  CampaignRow row;
  row.id = query.integer(0);
  row.state = query.text(1);
  row.request = parsed(query.text(2));
  row.result = parsed(query.text(3));
  row.trials = query.integer(4);
  row.created = query.integer(5);
  row.ended = query.maybe_integer(6);
  row.error = query.text(7);
  row.done = query.integer(8);
  row.failed = query.integer(9);
  return row;
}

std::vector<TrialRow> trial_rows(Database& database, std::int64_t campaign, TrialRange range) {
  auto query = database.cached(
      "SELECT position,seed,state,numbers,ticks,faults,warnings,error,run,metrics FROM campaign_trial "
      "WHERE campaign=? AND position BETWEEN ? AND ? ORDER BY position");
  query.all(campaign, range.from, range.to);
  std::vector<TrialRow> rows;
  while (query.step()) {
    TrialRow& row = rows.emplace_back();
    row.index = query.integer(0);
    row.seed = std::bit_cast<std::uint64_t>(query.integer(1));
    row.state = query.text(2);
    row.numbers = query.text(3);
    row.ticks = query.integer(4);
    if (!query.null(5)) row.faults = Json::parse(decompress_text(query.bytes(5)));
    row.warnings = parsed(query.text(6));
    row.error = query.text(7);
    row.run = query.maybe_integer(8);
    row.metrics = parsed(query.text(9));
  }
  return rows;
}

std::optional<CampaignCellRow> cell_row(Database& database, std::int64_t campaign, std::int64_t cell) {
  auto query = database.cached(
      "SELECT cell,sweep,designs,design,columns,accumulators,result FROM campaign_cell WHERE campaign=? AND cell=?");
  if (!query.all(campaign, cell).step()) return std::nullopt;
  CampaignCellRow row;
  row.cell = query.integer(0);
  row.sweep = parsed(query.text(1));
  row.designs = parsed(query.text(2));
  row.design = parsed(query.text(3));
  row.columns = parsed(query.text(4));
  if (!query.null(5)) row.accumulators = decompress_text(query.bytes(5));
  if (!query.null(6)) row.result = Json::parse(decompress_text(query.bytes(6)));
  return row;
}

}  // namespace

std::vector<CampaignRow> LogReader::campaigns() const {
  const auto database = state_->lease();
  auto query = database->cached(kCampaignColumns + "ORDER BY id DESC");
  std::vector<CampaignRow> rows;
  while (query.step()) rows.push_back(campaign_row(query));
  return rows;
}

std::optional<CampaignRow> LogReader::campaign(std::int64_t id) const {
  const auto database = state_->lease();
  auto query = database->cached(kCampaignColumns + "WHERE id=?");
  if (!query.bind(1, id).step()) return std::nullopt;
  return campaign_row(query);
}

std::vector<TrialRow> LogReader::trials(std::int64_t campaign, TrialRange range) const {
  const auto database = state_->lease();
  return trial_rows(*database, campaign, range);
}

std::vector<CampaignCellRow> LogReader::campaign_cells(std::int64_t campaign) const {
  const auto database = state_->lease();
  auto query = database->cached("SELECT cell,sweep,designs FROM campaign_cell WHERE campaign=? ORDER BY cell");
  query.bind(1, campaign);
  std::vector<CampaignCellRow> rows;
  while (query.step()) {
    CampaignCellRow& row = rows.emplace_back();
    row.cell = query.integer(0);
    row.sweep = parsed(query.text(1));
    row.designs = parsed(query.text(2));
  }
  return rows;
}

std::optional<CampaignCellRow> LogReader::campaign_cell(std::int64_t campaign, std::int64_t cell) const {
  const auto database = state_->lease();
  return cell_row(*database, campaign, cell);
}

std::optional<CampaignPart> LogReader::campaign_part(std::int64_t campaign, std::int64_t cell, TrialRange range) const {
  const auto database = state_->lease();
  const Transaction same(*database, "BEGIN");
  auto row = cell_row(*database, campaign, cell);
  if (!row) return std::nullopt;
  return CampaignPart{std::move(*row), trial_rows(*database, campaign, range)};
}

std::vector<SummaryRow> LogReader::campaign_summaries(std::int64_t campaign, std::int64_t first) const {
  const auto database = state_->lease();
  auto query = database->cached(
      "SELECT cell,summary,CASE WHEN summary IS NULL THEN result END FROM campaign_cell "
      "LEFT JOIN campaign_summary USING(campaign,cell) WHERE campaign=? AND cell>=? AND result IS NOT NULL "
      "ORDER BY cell");
  query.all(campaign, first);
  std::vector<SummaryRow> rows;
  while (query.step()) {
    // One that an older Vigil finished has no summary of its own.
    rows.push_back({query.integer(0), query.null(1) ? cell_summary(Json::parse(decompress_text(query.bytes(2))))
                                                    : decode_summary(query.bytes(1))});
  }
  return rows;
}

std::vector<ColumnsRow> LogReader::campaign_columns(std::int64_t campaign, std::int64_t first,
                                                    std::int64_t last) const {
  const auto database = state_->lease();
  auto query = database->cached(
      "SELECT cell,columns FROM campaign_cell WHERE campaign=? AND cell BETWEEN ? AND ? AND columns IS NOT NULL "
      "ORDER BY cell");
  query.all(campaign, first, last);
  std::vector<ColumnsRow> rows;
  std::string known;
  while (query.step()) {
    std::string text = query.text(1);
    std::shared_ptr<const Json> columns;
    if (!rows.empty() && text == known) {
      columns = rows.back().columns;
    } else {
      columns = std::make_shared<const Json>(parsed(text));
      known = std::move(text);
    }
    rows.push_back({query.integer(0), std::move(columns)});
  }
  return rows;
}

void LogReader::each_trial(std::int64_t campaign, TrialRange range,
                           const std::function<void(std::int64_t, std::string_view)>& call) const {
  const auto database = state_->lease();
  auto query = database->cached(
      "SELECT position,numbers FROM campaign_trial WHERE campaign=? AND position BETWEEN ? AND ? ORDER BY position");
  query.all(campaign, range.from, range.to);
  while (query.step()) call(query.integer(0), query.bytes(1));
}

}  // namespace vigil
