#include "db/maintenance.hpp"

#include <chrono>
#include <filesystem>

#include "db/check.hpp"
#include "db/lock_file.hpp"
#include "db/schema.hpp"
#include "db/upkeep.hpp"

namespace vigil {

namespace {

std::int64_t file_bytes(const std::string& path) {
  std::int64_t bytes = 0;
  for (const char* suffix : {"", "-wal"}) {
    std::error_code missing;
    const auto size = std::filesystem::file_size(path + suffix, missing);
    if (!missing) bytes += static_cast<std::int64_t>(size);
  }
  return bytes;
}

void require_file(const std::string& path) {
  std::error_code error;
  if (std::filesystem::is_regular_file(path, error)) return;
  throw LogError(LogError::Kind::missing, "There is no log " + path + ".");
}

[[noreturn]] void rethrow(const SqlError& error, const std::string& what) {
  throw LogError(error.disk() ? LogError::Kind::disk : LogError::Kind::unusable, what + ": " + error.what() + ".");
}

std::string megabytes(std::int64_t bytes) {
  char text[48];
  std::snprintf(text, sizeof text, "%.1f MB", static_cast<double>(bytes) / 1e6);
  return text;
}

void copy_pages(Database& from, Database& to) {
  sqlite3_backup* const copy = sqlite3_backup_init(to.handle(), "main", from.handle(), "main");
  if (!copy) throw SqlError(sqlite3_extended_errcode(to.handle()), sqlite3_errmsg(to.handle()));
  int code = SQLITE_OK;
  while (code == SQLITE_OK || code == SQLITE_BUSY || code == SQLITE_LOCKED) {
    code = sqlite3_backup_step(copy, 256);
    if (code == SQLITE_BUSY || code == SQLITE_LOCKED) sqlite3_sleep(20);
  }
  const int end = sqlite3_backup_finish(copy);
  if (code != SQLITE_DONE) throw SqlError(code, sqlite3_errstr(code));
  if (end != SQLITE_OK) throw SqlError(end, sqlite3_errstr(end));
}

void remove_file(const std::string& path) {
  std::error_code ignored;
  for (const char* suffix : {"", "-wal", "-shm", "-journal"}) std::filesystem::remove(path + suffix, ignored);
}

/// Gives every unused page back and empties the write-ahead log.
void shrink(Database& database) {
  database.execute("PRAGMA incremental_vacuum");
  database.execute("PRAGMA wal_checkpoint(TRUNCATE)");
}

}  // namespace

MaintenanceReport check_log(const std::string& path) {
  require_file(path);
  const auto database = open_for_reading(path);
  try {
    MaintenanceReport report = check_database(*database);
    report.bytes_before = report.bytes_after = file_bytes(path);
    return report;
  } catch (const SqlError& error) {
    MaintenanceReport report;
    report.ok = false;
    report.sentences.push_back("The file cannot be read to its end: " + std::string(error.what()) + ".");
    return report;
  }
}

MaintenanceReport backup_log(const std::string& path, const std::string& target) {
  require_file(path);
  if (std::filesystem::exists(target)) {
    throw LogError(LogError::Kind::conflict, "The file " + target + " exists already; name a new one.");
  }
  const auto source = open_for_reading(path);
  try {
    {
      Database copy(target, Database::Mode::create);
      // One read transaction, or a busy writer would make the copy start again and again.
      Transaction still(*source, "BEGIN");
      source->integer("SELECT count(*) FROM run");
      copy_pages(*source, copy);
    }
    MaintenanceReport report = check_log(target);
    report.bytes_before = file_bytes(path);
    report.sentences.insert(report.sentences.begin(),
                            "Copied to " + target + " (" + megabytes(report.bytes_after) + ").");
    return report;
  } catch (const SqlError& error) {
    remove_file(target);
    rethrow(error, "The copy " + target + " could not be written");
  }
}

MaintenanceReport prune_log(const std::string& path, double days, const std::function<WallTime()>& clock) {
  require_file(path);
  const LockFile lock(path);
  const auto database = open_for_writing(path);
  try {
    MaintenanceReport report;
    report.bytes_before = file_bytes(path);
    const auto system = std::chrono::system_clock::now().time_since_epoch();
    const WallTime now = clock ? clock() : std::chrono::duration_cast<std::chrono::nanoseconds>(system).count();
    Upkeep upkeep(*database, 8u << 20);
    upkeep.retain({days, std::nullopt}, now);
    report.runs = database->integer("SELECT count(*) FROM run WHERE deleted=1");
    while (upkeep.purge()) upkeep.checkpoint(false);
    shrink(*database);
    report.bytes_after = file_bytes(path);
    report.sentences.push_back("Removed " + std::to_string(report.runs) + " runs; the file went from " +
                               megabytes(report.bytes_before) + " to " + megabytes(report.bytes_after) + ".");
    return report;
  } catch (const SqlError& error) {
    rethrow(error, "The log " + path + " could not be pruned");
  }
}

MaintenanceReport vacuum_log(const std::string& path) {
  require_file(path);
  const LockFile lock(path);
  const auto database = open_for_writing(path);
  try {
    MaintenanceReport report;
    report.bytes_before = file_bytes(path);
    Upkeep upkeep(*database, 8u << 20);
    while (upkeep.purge()) upkeep.checkpoint(false);
    database->execute("VACUUM");
    shrink(*database);
    report.bytes_after = file_bytes(path);
    report.sentences.push_back("The file went from " + megabytes(report.bytes_before) + " to " +
                               megabytes(report.bytes_after) + ".");
    return report;
  } catch (const SqlError& error) {
    rethrow(error, "The log " + path + " could not be vacuumed");
  }
}

}  // namespace vigil
