/// LogWriter's calls on scenarios, traces, settings and campaigns.
#include <bit>

#include "db/chunk.hpp"
#include "db/writer_state.hpp"

namespace vigil {

namespace {
constexpr int kDesignsKept = 500;
}

void LogWriter::put_scenario(const std::string& id, const Json& document) {
  const WallTime now = state_->now();
  state_->commit_now([&](Database& database) {
    database
        .cached(
            "INSERT INTO scenario(id,document,created,updated) VALUES(?1,?2,?3,?3) "
            "ON CONFLICT(id) DO UPDATE SET document=?2,updated=?3")
        .all(id, dump(document), now)
        .run();
  });
}

bool LogWriter::delete_scenario(const std::string& id) {
  bool there = false;
  state_->commit_now([&](Database& database) {
    database.cached("DELETE FROM scenario WHERE id=?").bind(1, id).run();
    there = database.changes() > 0;
  });
  return there;
}

std::int64_t LogWriter::put_trace(const std::string& name, std::string_view csv, std::int64_t rows,
                                  const std::vector<std::string>& columns) {
  const std::string hash = sha256_hex(csv), packed = compress_text(csv);
  const WallTime now = state_->now();
  std::int64_t id = 0;
  state_->commit_now([&](Database& database) {
    auto known = database.cached("SELECT id FROM trace WHERE hash=?");
    if (known.bind(1, hash).step()) {
      id = known.integer(0);
      return;
    }
    auto insert = database.cached("INSERT INTO trace(name,hash,rows,columns,bytes,created,csv) VALUES(?,?,?,?,?,?,?)");
    insert.all(name, hash, rows, dump(Json(columns)), static_cast<std::int64_t>(csv.size()), now).blob(7, packed).run();
    id = database.last_id();
  });
  return id;
}

bool LogWriter::delete_trace(std::int64_t id) {
  bool there = false;
  state_->commit_now([&](Database& database) {
    database.cached("DELETE FROM trace WHERE id=?").bind(1, id).run();
    there = database.changes() > 0;
  });
  return there;
}

void LogWriter::set_setting(const std::string& key, const Json& value) {
  state_->commit_now([&](Database& database) {
    database.cached("INSERT OR REPLACE INTO setting(key,value) VALUES(?,?)").all(key, dump(value)).run();
  });
}

void LogWriter::put_design(const std::string& key, const std::string& lane, const Json& record,
                           std::string_view problem) {
  const std::string packed = compress_text(problem);
  const WallTime now = state_->now();
  state_->commit_now([&](Database& database) {
    auto insert = database.cached("INSERT OR REPLACE INTO design(key,lane,record,created,problem) VALUES(?,?,?,?,?)");
    insert.all(key, lane, dump(record), now).blob(5, packed).run();
    database.cached("DELETE FROM design WHERE key NOT IN(SELECT key FROM design ORDER BY created DESC LIMIT ?)")
        .bind(1, kDesignsKept)
        .run();
  });
}

std::int64_t LogWriter::create_campaign(const Json& request, std::int64_t trials) {
  const WallTime now = state_->now();
  std::int64_t id = 0;
  state_->commit_now([&](Database& database) {
    database.cached("INSERT INTO campaign(state,request,trials,created) VALUES('queued',?,?,?)")
        .all(dump(request), trials, now)
        .run();
    id = database.last_id();
  });
  return id;
}

void LogWriter::update_campaign(std::int64_t id, const std::string& state, const Json& result,
                                const std::string& error) {
  const bool ended = state != "queued" && state != "running" && state != "paused";
  const auto end = ended ? std::optional(state_->now()) : std::nullopt;
  const auto text = result.is_null() ? std::nullopt : std::optional(dump(result));
  state_->commit_now([&](Database& database) {
    database.cached("UPDATE campaign SET state=?,result=coalesce(?,result),error=?,ended=? WHERE id=?")
        .all(state, text, error, end, id)
        .run();
    if (database.changes() == 0) {
      throw LogError(LogError::Kind::missing, "There is no campaign " + std::to_string(id) + ".");
    }
  });
}

void LogWriter::add_trial(std::int64_t campaign, const TrialRow& trial) {
  Job job;
  job.apply = [campaign, trial](Database& database) {
    database.cached("INSERT OR REPLACE INTO campaign_trial(campaign,position,seed,state,metrics) VALUES(?,?,?,?,?)")
        .all(campaign, trial.index, std::bit_cast<std::int64_t>(trial.seed), trial.state, dump(trial.metrics))
        .run();
  };
  state_->submit_and_wait(std::move(job));
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
