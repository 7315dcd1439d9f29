/// LogWriter's calls on campaigns.
#include <bit>

#include "db/cell_summary.hpp"
#include "db/chunk.hpp"
#include "db/writer_state.hpp"

namespace vigil {
namespace {

std::optional<std::string> text_of(const Json& json) {
  return json.is_null() ? std::nullopt : std::optional(dump(json));
}

[[noreturn]] void missing(std::int64_t id) {
  throw LogError(LogError::Kind::missing, "There is no campaign " + std::to_string(id) + ".");
}

std::optional<std::int64_t> known_campaign(Database& database, const NewCampaign& campaign, WallTime now) {
  if (campaign.idempotency_key.empty()) return std::nullopt;
  auto query = database.cached("SELECT hash,id FROM campaign WHERE key=? AND created>? ORDER BY id DESC LIMIT 1");
  if (!query.all(campaign.idempotency_key, now - kKeyLife).step()) return std::nullopt;
  if (query.text(0) == campaign.idempotency_hash) return query.integer(1);
  throw LogError(LogError::Kind::conflict, "The idempotency key " + campaign.idempotency_key +
                                               " was used in the last 24 hours with another request body.");
}

std::int64_t insert_campaign(Database& database, const NewCampaign& campaign, WallTime now) {
  const bool keyed = !campaign.idempotency_key.empty();
  database.cached("INSERT INTO campaign(state,request,trials,created,key,hash) VALUES('queued',?,?,?,?,?)")
      .all(dump(campaign.request), campaign.trials, now, keyed ? std::optional(campaign.idempotency_key) : std::nullopt,
           keyed ? std::optional(campaign.idempotency_hash) : std::nullopt)
      .run();
  const std::int64_t id = database.last_id();
  auto cell = database.cached("INSERT INTO campaign_cell(campaign,cell,sweep,designs) VALUES(?,?,?,?)");
  for (const CampaignCellRow& row : campaign.cells) cell.all(id, row.cell, dump(row.sweep), text_of(row.designs)).run();
  return id;
}

void insert_trials(Database& database, std::int64_t campaign, const std::vector<TrialRow>& trials) {
  auto insert = database.cached(
      "INSERT OR REPLACE INTO campaign_trial(campaign,position,seed,state,metrics,ticks,faults,warnings,error,run,"
      "numbers) VALUES(?,?,?,?,'',?,?,?,?,?,?)");
  for (const TrialRow& row : trials) {
    const std::string faults = row.faults.is_null() ? "" : compress_text(dump(row.faults));
    insert.all(campaign, row.index, std::bit_cast<std::int64_t>(row.seed), row.state, row.ticks, std::nullopt,
               text_of(row.warnings), row.error, row.run);
    if (!row.faults.is_null()) insert.blob(6, faults);
    insert.blob(10, row.numbers).run();
  }
}

void update_cell(Database& database, std::int64_t campaign, const CampaignCellRow& row) {
  auto update = database.cached(
      "UPDATE campaign_cell SET design=?3,columns=?4,accumulators=?5,result=?6 WHERE campaign=?1 AND cell=?2");
  const std::string accumulators = compress_text(row.accumulators);
  const std::string result = row.result.is_null() ? "" : compress_text(dump(row.result));
  update.all(campaign, row.cell, text_of(row.design), text_of(row.columns)).blob(5, accumulators);
  if (row.result.is_null()) {
    update.bind(6, std::nullopt);
  } else {
    update.blob(6, result);
  }
  update.run();
  if (row.result.is_null()) return;
  const std::string summary = encode(cell_summary(row.result));
  database.cached("INSERT OR REPLACE INTO campaign_summary(campaign,cell,summary) VALUES(?,?,?)")
      .all(campaign, row.cell)
      .blob(3, summary)
      .run();
}

}  // namespace

CreatedCampaign LogWriter::create_campaign(const NewCampaign& campaign) {
  const WallTime now = state_->now();
  CreatedCampaign created;
  state_->commit_now([&](Database& database) {
    const auto known = known_campaign(database, campaign, now);
    created.fresh = !known;
    created.id = known ? *known : insert_campaign(database, campaign, now);
  });
  return created;
}

void LogWriter::update_campaign(std::int64_t id, const std::string& state, const std::string& error) {
  const bool open = state == "queued" || state == "running" || state == "paused" || state == "interrupted";
  const auto end = open ? std::nullopt : std::optional(state_->now());
  state_->commit_now([&](Database& database) {
    database.cached("UPDATE campaign SET state=?,error=?,ended=? WHERE id=?").all(state, error, end, id).run();
    if (database.changes() == 0) missing(id);
  });
}

void LogWriter::describe_campaign(std::int64_t id, const Json& changes) {
  state_->commit_now([&](Database& database) {
    Json request;
    {
      auto query = database.cached("SELECT request FROM campaign WHERE id=?");
      if (!query.bind(1, id).step()) missing(id);
      request = Json::parse(query.text(0));
    }
    request.update(changes);
    database.cached("UPDATE campaign SET request=? WHERE id=?").all(dump(request), id).run();
  });
}

void LogWriter::set_cell_designs(std::int64_t campaign, std::int64_t cell, const Json& designs) {
  state_->commit_now([&](Database& database) {
    database.cached("UPDATE campaign_cell SET designs=? WHERE campaign=? AND cell=?")
        .all(dump(designs), campaign, cell)
        .run();
  });
}

std::future<void> LogWriter::add_trials(std::int64_t campaign, CampaignBatch batch) {
  LogJob job;
  job.apply = [campaign, batch = std::make_shared<const CampaignBatch>(std::move(batch))](Database& database) {
    auto there = database.cached("SELECT 1 FROM campaign WHERE id=?");
    if (!there.bind(1, campaign).step()) missing(campaign);
    insert_trials(database, campaign, batch->trials);
    for (const CampaignCellRow& cell : batch->cells) update_cell(database, campaign, cell);
  };
  job.promise = std::make_shared<std::promise<void>>();
  job.deadline = std::chrono::steady_clock::now() + std::chrono::milliseconds(state_->options.patience_milliseconds);
  auto done = job.promise->get_future();
  state_->submit(std::move(job));
  return done;
}

bool LogWriter::delete_campaign(std::int64_t id) {
  bool there = false;
  state_->commit_now([&](Database& database) {
    database.cached("DELETE FROM campaign WHERE id=?").bind(1, id).run();
    there = database.changes() > 0;
  });
  return there;
}

}  // namespace vigil
