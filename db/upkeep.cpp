#include "db/upkeep.hpp"

#include <algorithm>
#include <string>

#include "db/rollup.hpp"
#include "db/schema.hpp"

namespace vigil {

namespace {

constexpr std::int64_t kChunksAStep = 1000;
constexpr std::int64_t kRowsAStep = 5000;
constexpr std::int64_t kFreePagesKept = 2048;
constexpr double kDay = 86400e9;

const char* const kEnded = "deleted=0 AND ended IS NOT NULL AND state IN('finished','stopped','failed','interrupted')";
const char* const kTagged = "EXISTS(SELECT 1 FROM json_each(run.tags) WHERE value='keep')";

}  // namespace

std::int64_t used_bytes(const Database& database) {
  const auto pages = database.integer("PRAGMA page_count") - database.integer("PRAGMA freelist_count");
  return pages * database.integer("PRAGMA page_size");
}

Upkeep::Upkeep(Database& database, std::size_t checkpoint_bytes)
    : database_(database),
      checkpoint_bytes_(checkpoint_bytes),
      page_size_(static_cast<std::size_t>(database.integer("PRAGMA page_size"))) {
  sqlite3_wal_hook(database_.handle(), &Upkeep::count_pages, this);
}

int Upkeep::count_pages(void* self, sqlite3*, const char*, int pages) {
  static_cast<Upkeep*>(self)->log_pages_ = static_cast<std::size_t>(pages);
  return SQLITE_OK;
}

void Upkeep::checkpoint(bool idle) {
  if (log_pages_ == 0 || (!idle && log_pages_ * page_size_ < checkpoint_bytes_)) return;
  sqlite3_wal_checkpoint_v2(database_.handle(), nullptr, SQLITE_CHECKPOINT_PASSIVE, nullptr, nullptr);
  log_pages_ = 0;
}

void Upkeep::expire_block(RunId run, std::int64_t block) {
  database_.cached("DELETE FROM block WHERE run=? AND block=?").all(run, block).run();
  database_.cached("DELETE FROM chunk WHERE run=? AND block=?").all(run, block).run();
  auto rollup = database_.cached("DELETE FROM rollup WHERE run=? AND sig=? AND level=? AND b<=?");
  auto signals = database_.cached("SELECT id FROM signal WHERE run=? AND slot IS NOT NULL");
  signals.bind(1, run);
  while (signals.step()) {
    for (std::size_t level = 0; level < kRollupRows.size(); ++level) {
      const std::int64_t bucket = (block + 1) * kBlockRows / kRollupRows[level] - 1;
      rollup.all(run, signals.integer(0), static_cast<int>(level), bucket).run();
    }
  }
}

bool Upkeep::expire_samples(WallTime now) {
  struct Old {
    RunId run;
    std::int64_t block, end;
  };
  std::optional<Old> old;
  {
    auto query = database_.cached(
        "SELECT r.id,b.block,(b.first+b.n)*r.every FROM run r JOIN block b ON b.run=r.id "
        "WHERE r.keep IS NOT NULL AND r.deleted=0 AND b.written < ?1 - r.keep*1e9 LIMIT 1");
    if (query.bind(1, now).step()) old = Old{query.integer(0), query.integer(1), query.integer(2)};
  }
  auto tails = database_.cached(
      "SELECT 1 FROM run r JOIN tail t ON t.run=r.id WHERE r.keep IS NOT NULL AND r.deleted=0 AND r.ended IS NOT NULL "
      "AND r.ended < ?1 - r.keep*1e9 LIMIT 1");
  const bool tail = tails.bind(1, now).step();
  tails.reset();
  if (!old && !tail) return false;
  Transaction transaction(database_);
  if (old) {
    expire_block(old->run, old->block);
    database_.cached("DELETE FROM mark WHERE run=? AND k<? AND type NOT IN('command','state')")
        .all(old->run, old->end)
        .run();
    database_.cached("DELETE FROM gap WHERE run=? AND last<?").all(old->run, old->end).run();
  }
  if (tail) {
    database_
        .cached(
            "DELETE FROM tail WHERE run IN (SELECT id FROM run WHERE keep IS NOT NULL AND ended IS NOT NULL "
            "AND ended < ?1 - keep*1e9)")
        .bind(1, now)
        .run();
  }
  transaction.commit();
  return true;
}

void Upkeep::retain(const RetentionLimits& limits, WallTime now) {
  if (limits.days) {
    const auto before = now - static_cast<WallTime>(std::min(*limits.days, 36500.0) * kDay);
    Transaction transaction(database_);
    database_.cached(joined({"UPDATE run SET deleted=1 WHERE ended<? AND ", kEnded, " AND NOT ", kTagged}))
        .bind(1, before)
        .run();
    transaction.commit();
  }
  if (!above(limits) || removing()) return;
  Transaction transaction(database_);
  database_
      .cached(joined({"UPDATE run SET deleted=1 WHERE id=(SELECT id FROM run WHERE ", kEnded, " ORDER BY ", kTagged,
                      ",ended,id LIMIT 1)"}))
      .run();
  transaction.commit();
}

bool Upkeep::above(const RetentionLimits& limits) const {
  return limits.gib && static_cast<double>(used_bytes(database_)) > *limits.gib * 1073741824.0;
}

bool Upkeep::trim(const RetentionLimits& limits) {
  if (!above(limits) || removing()) return false;
  if (database_.integer(joined({"SELECT EXISTS(SELECT 1 FROM run WHERE ", kEnded, ")"})) != 0) return false;
  auto query = database_.cached("SELECT run,block FROM block ORDER BY written,run,block LIMIT 1");
  if (!query.step()) return false;
  const RunId run = query.integer(0);
  const std::int64_t block = query.integer(1);
  query.reset();
  Transaction transaction(database_);
  expire_block(run, block);
  transaction.commit();
  return true;
}

bool Upkeep::removing() const { return database_.integer("SELECT count(*) FROM run WHERE deleted=1") > 0; }

bool Upkeep::purge_run(RunId run) {
  const auto width = std::max<std::int64_t>(
      1, database_.integer("SELECT count(*) FROM signal WHERE slot IS NOT NULL AND run=" + std::to_string(run)));
  const std::int64_t blocks = std::max<std::int64_t>(1, kChunksAStep / width);
  const auto step = [&](const char* sql, std::int64_t limit) {
    database_.cached(sql).all(run, limit).run();
    return database_.changes() > 0;
  };
  database_
      .cached(
          "DELETE FROM chunk WHERE run=?1 AND block IN (SELECT block FROM block WHERE run=?1 ORDER BY block LIMIT ?2)")
      .all(run, blocks)
      .run();
  if (step("DELETE FROM block WHERE run=?1 AND block IN (SELECT block FROM block WHERE run=?1 ORDER BY block LIMIT ?2)",
           blocks)) {
    return true;
  }
  if (step("DELETE FROM rollup WHERE run=?1 AND (run,sig,level,b) IN (SELECT run,sig,level,b FROM rollup WHERE run=?1 "
           "LIMIT ?2)",
           kRowsAStep)) {
    return true;
  }
  if (step("DELETE FROM mark WHERE id IN (SELECT id FROM mark WHERE run=?1 LIMIT ?2)", kRowsAStep)) return true;
  database_.cached("DELETE FROM chunk WHERE run=?").bind(1, run).run();
  database_.cached("DELETE FROM tail WHERE run=?").bind(1, run).run();
  database_.cached("DELETE FROM run WHERE id=?").bind(1, run).run();
  return true;
}

bool Upkeep::purge() {
  if (const RunId run = database_.integer("SELECT min(id) FROM run WHERE deleted=1"); run > 0) {
    Transaction transaction(database_);
    purge_run(run);
    transaction.commit();
    return true;
  }
  const auto spare = database_.integer("PRAGMA freelist_count") - kFreePagesKept;
  if (spare <= 0) return false;
  database_.execute("PRAGMA incremental_vacuum(" + std::to_string(std::min<std::int64_t>(spare, 512)) + ")");
  return spare > 512;
}

void Upkeep::forget_old_keys(WallTime now) {
  database_.cached("DELETE FROM idempotency WHERE created<?").bind(1, now - static_cast<WallTime>(kDay)).run();
}

}  // namespace vigil
