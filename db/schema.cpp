#include "db/schema.hpp"

#include <filesystem>

#include "db/records.hpp"

namespace vigil {

namespace {

constexpr int kApplicationId = 0x56676c31;  // "Vgl1"

const char* const kVersion1 = R"sql(
CREATE TABLE run(
  id INTEGER PRIMARY KEY AUTOINCREMENT, scenario TEXT NOT NULL, family TEXT NOT NULL, title TEXT NOT NULL,
  state TEXT NOT NULL CHECK(state IN('queued','designing','running','paused','finished','stopped','failed','interrupted')),
  seed INTEGER NOT NULL, version TEXT NOT NULL, cpu TEXT NOT NULL, pace TEXT NOT NULL, input TEXT NOT NULL, trace INTEGER,
  tags TEXT NOT NULL, note TEXT NOT NULL, created INTEGER NOT NULL, started INTEGER, ended INTEGER,
  parent_run INTEGER, parent_k INTEGER, dt REAL NOT NULL, steps INTEGER, k INTEGER NOT NULL DEFAULT -1,
  every INTEGER NOT NULL DEFAULT 1, policy TEXT NOT NULL, keep REAL, reproducible INTEGER NOT NULL,
  document_hash TEXT NOT NULL, error TEXT NOT NULL DEFAULT '', deleted INTEGER NOT NULL DEFAULT 0);
CREATE INDEX run_by_end ON run(ended) WHERE deleted=0;
CREATE INDEX run_keep ON run(id) WHERE keep IS NOT NULL;
CREATE INDEX run_deleted ON run(id) WHERE deleted=1;
CREATE TABLE document(
  run INTEGER PRIMARY KEY REFERENCES run(id) ON DELETE CASCADE, body TEXT NOT NULL, design TEXT, world TEXT,
  warnings TEXT NOT NULL DEFAULT '[]');
CREATE TABLE signal(
  run INTEGER NOT NULL REFERENCES run(id) ON DELETE CASCADE, id INTEGER NOT NULL, name TEXT NOT NULL, unit TEXT NOT NULL,
  kind TEXT NOT NULL, lane TEXT NOT NULL, node TEXT NOT NULL, link TEXT NOT NULL, labels TEXT NOT NULL, slot INTEGER,
  PRIMARY KEY(run,id)) WITHOUT ROWID;
CREATE TABLE block(
  run INTEGER NOT NULL, block INTEGER NOT NULL, first INTEGER NOT NULL, n INTEGER NOT NULL, written INTEGER NOT NULL,
  PRIMARY KEY(run,block)) WITHOUT ROWID;
CREATE TABLE chunk(
  run INTEGER NOT NULL, block INTEGER NOT NULL, sig INTEGER NOT NULL, data BLOB NOT NULL,
  PRIMARY KEY(run,block,sig)) WITHOUT ROWID;
CREATE TABLE rollup(
  run INTEGER NOT NULL, sig INTEGER NOT NULL, level INTEGER NOT NULL, b INTEGER NOT NULL, lo REAL, hi REAL, mean REAL,
  n INTEGER NOT NULL, nan INTEGER NOT NULL, PRIMARY KEY(run,sig,level,b)) WITHOUT ROWID;
CREATE TABLE tail(run INTEGER NOT NULL, k INTEGER NOT NULL, v BLOB NOT NULL, PRIMARY KEY(run,k)) WITHOUT ROWID;
CREATE TABLE gap(
  run INTEGER NOT NULL REFERENCES run(id) ON DELETE CASCADE, first INTEGER NOT NULL, last INTEGER NOT NULL,
  PRIMARY KEY(run,first)) WITHOUT ROWID;
CREATE TABLE mark(
  id INTEGER PRIMARY KEY, run INTEGER NOT NULL REFERENCES run(id) ON DELETE CASCADE, k INTEGER NOT NULL,
  type TEXT NOT NULL, edge TEXT NOT NULL, ref TEXT NOT NULL, lane TEXT NOT NULL, node TEXT NOT NULL, link TEXT NOT NULL,
  code TEXT NOT NULL, detail TEXT NOT NULL);
CREATE INDEX mark_by_tick ON mark(run,k,id);
CREATE TABLE command(
  id INTEGER PRIMARY KEY, run INTEGER NOT NULL REFERENCES run(id) ON DELETE CASCADE, k INTEGER NOT NULL, body TEXT NOT NULL);
CREATE INDEX command_by_run ON command(run,id);
CREATE TABLE metric(
  run INTEGER NOT NULL REFERENCES run(id) ON DELETE CASCADE, position INTEGER NOT NULL, lane TEXT NOT NULL,
  node TEXT NOT NULL, name TEXT NOT NULL, variant TEXT NOT NULL, value REAL, boolean INTEGER NOT NULL,
  PRIMARY KEY(run,position)) WITHOUT ROWID;
CREATE INDEX metric_by_name ON metric(run,name,lane) WHERE node='';
CREATE TABLE fault(
  run INTEGER NOT NULL REFERENCES run(id) ON DELETE CASCADE, position INTEGER NOT NULL, lane TEXT NOT NULL,
  node TEXT NOT NULL, code TEXT NOT NULL, first INTEGER NOT NULL, last INTEGER NOT NULL, count INTEGER NOT NULL,
  stopped INTEGER NOT NULL, detail TEXT NOT NULL, PRIMARY KEY(run,position)) WITHOUT ROWID;
CREATE TABLE campaign(
  id INTEGER PRIMARY KEY AUTOINCREMENT, state TEXT NOT NULL, request TEXT NOT NULL, result TEXT, trials INTEGER NOT NULL,
  created INTEGER NOT NULL, ended INTEGER, error TEXT NOT NULL DEFAULT '');
CREATE TABLE campaign_trial(
  campaign INTEGER NOT NULL REFERENCES campaign(id) ON DELETE CASCADE, position INTEGER NOT NULL, seed INTEGER NOT NULL,
  state TEXT NOT NULL, metrics TEXT NOT NULL, PRIMARY KEY(campaign,position)) WITHOUT ROWID;
CREATE TABLE scenario(id TEXT PRIMARY KEY, document TEXT NOT NULL, created INTEGER NOT NULL, updated INTEGER NOT NULL);
CREATE TABLE trace(
  id INTEGER PRIMARY KEY AUTOINCREMENT, name TEXT NOT NULL, hash TEXT NOT NULL UNIQUE, rows INTEGER NOT NULL,
  columns TEXT NOT NULL, bytes INTEGER NOT NULL, created INTEGER NOT NULL, csv BLOB NOT NULL);
CREATE TABLE setting(key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE idempotency(
  key TEXT PRIMARY KEY, hash TEXT NOT NULL, run INTEGER NOT NULL REFERENCES run(id) ON DELETE CASCADE,
  created INTEGER NOT NULL) WITHOUT ROWID;
CREATE INDEX idempotency_by_run ON idempotency(run);
)sql";

// Gains: those that a run was made with, and all that were found, by the problem they answer.
const char* const kVersion2 = R"sql(
ALTER TABLE document ADD COLUMN designs TEXT;
CREATE TABLE design(
  key TEXT PRIMARY KEY, lane TEXT NOT NULL, record TEXT NOT NULL, problem BLOB NOT NULL, created INTEGER NOT NULL);
CREATE INDEX design_by_age ON design(created);
)sql";

// Campaigns that survive: trials as plain numbers, one row a point of the grid with what is merged so far. Those begun
// before kept too little to be gone on with.
const char* const kVersion3 = R"sql(
ALTER TABLE campaign ADD COLUMN key TEXT;
ALTER TABLE campaign ADD COLUMN hash TEXT;
CREATE INDEX campaign_by_key ON campaign(key) WHERE key IS NOT NULL;
ALTER TABLE campaign_trial ADD COLUMN numbers BLOB;
ALTER TABLE campaign_trial ADD COLUMN ticks INTEGER NOT NULL DEFAULT 0;
ALTER TABLE campaign_trial ADD COLUMN faults BLOB;
ALTER TABLE campaign_trial ADD COLUMN warnings TEXT;
ALTER TABLE campaign_trial ADD COLUMN error TEXT NOT NULL DEFAULT '';
ALTER TABLE campaign_trial ADD COLUMN run INTEGER;
CREATE INDEX campaign_trial_lost ON campaign_trial(campaign) WHERE state<>'finished';
CREATE TABLE campaign_cell(
  campaign INTEGER NOT NULL REFERENCES campaign(id) ON DELETE CASCADE, cell INTEGER NOT NULL, sweep TEXT NOT NULL,
  designs TEXT, design TEXT, columns TEXT, accumulators BLOB, result BLOB, PRIMARY KEY(campaign,cell)) WITHOUT ROWID;
UPDATE campaign SET state='cancelled',error='It was begun by an older Vigil and cannot be gone on with.'
  WHERE state IN('queued','running','paused','interrupted');
)sql";

// The metrics of cells that are whole, beside everything else that is said of them: a page reads those of all cells.
const char* const kVersion4 = R"sql(
CREATE TABLE campaign_summary(
  campaign INTEGER NOT NULL REFERENCES campaign(id) ON DELETE CASCADE, cell INTEGER NOT NULL, summary BLOB NOT NULL,
  PRIMARY KEY(campaign,cell)) WITHOUT ROWID;
)sql";

const char* const kMigrations[kSchemaVersion] = {kVersion1, kVersion2, kVersion3, kVersion4};

[[noreturn]] void unusable(const std::string& sentence) { throw LogError(LogError::Kind::unusable, sentence); }

std::string quoted(const std::string& path) { return "The log " + path; }

/// -1: empty file; throws where it is not ours.
int version_of(const Database& database, const std::string& path) {
  const auto application = database.integer("PRAGMA application_id");
  const auto version = database.integer("PRAGMA user_version");
  if (application == kApplicationId) return static_cast<int>(version);
  if (database.integer("SELECT count(*) FROM sqlite_schema") == 0) return -1;
  unusable(quoted(path) + " is an SQLite database of another program; name another file.");
}

[[noreturn]] void explain(const SqlError& error, const std::string& path) {
  switch (error.code() & 0xff) {
    case SQLITE_NOTADB:
      unusable(quoted(path) + " is not a database; name another file.");
    case SQLITE_CORRUPT:
      unusable(quoted(path) + " is damaged (" + error.what() + "); restore a backup or name another file.");
    case SQLITE_CANTOPEN:
      unusable(quoted(path) + " cannot be opened: the file or its folder is missing or not accessible.");
    case SQLITE_READONLY:
    case SQLITE_PERM:
      unusable(quoted(path) + " is not writable.");
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      unusable(quoted(path) + " is in use by another program.");
    default:
      unusable(quoted(path) + " cannot be used: " + error.what() + ".");
  }
}

void too_new(const std::string& path, int version) {
  unusable(quoted(path) + " was written by a newer Vigil (schema " + std::to_string(version) + ", this one knows " +
           std::to_string(kSchemaVersion) + ").");
}

}  // namespace

void migrate(Database& database, const std::string& path) {
  int version = version_of(database, path);
  if (version > kSchemaVersion) too_new(path, version);
  if (version == kSchemaVersion) return;
  Transaction transaction(database, "BEGIN EXCLUSIVE");
  if (version < 0) database.execute("PRAGMA application_id=" + std::to_string(kApplicationId));
  for (version = std::max(version, 0); version < kSchemaVersion; ++version) database.execute(kMigrations[version]);
  database.execute("PRAGMA user_version=" + std::to_string(kSchemaVersion));
  transaction.commit();
}

void require_schema(const Database& database, const std::string& path) {
  const int version = version_of(database, path);
  if (version > kSchemaVersion) too_new(path, version);
  if (version < kSchemaVersion)
    unusable(quoted(path) + " has an older schema or none; a server that opens it brings it up to date.");
}

std::unique_ptr<Database> open_for_reading(const std::string& path) {
  try {
    auto database = std::make_unique<Database>(path, Database::Mode::read_only);
    database->execute("PRAGMA mmap_size=0; PRAGMA query_only=ON");
    require_schema(*database, path);
    return database;
  } catch (const SqlError& error) {
    explain(error, path);
  }
}

std::unique_ptr<Database> open_for_writing(const std::string& path) {
  try {
    auto database = std::make_unique<Database>(path, Database::Mode::create);
    if (sqlite3_db_readonly(database->handle(), "main") == 1) unusable(quoted(path) + " is not writable.");
    const int version = version_of(*database, path);
    if (version > kSchemaVersion) too_new(path, version);
    database->execute("PRAGMA auto_vacuum=INCREMENTAL; PRAGMA journal_mode=WAL; PRAGMA synchronous=FULL");
    database->execute("PRAGMA wal_autocheckpoint=0; PRAGMA mmap_size=0; PRAGMA foreign_keys=ON");
    database->execute("PRAGMA journal_size_limit=16777216; PRAGMA cache_size=-16384; PRAGMA temp_store=MEMORY");
    const std::string health = version < 0 ? "ok" : database->text("PRAGMA quick_check(1)");
    if (health != "ok") unusable(quoted(path) + " is damaged (" + health + "); restore a backup or name another file.");
    migrate(*database, path);
    return database;
  } catch (const SqlError& error) {
    explain(error, path);
  }
}

}  // namespace vigil
