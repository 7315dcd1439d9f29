/// What the writer does between commits: short lives, retention, removal in small steps, checkpoints.
#pragma once

#include <cstdint>
#include <optional>

#include "db/database.hpp"
#include "db/records.hpp"

namespace vigil {

struct RetentionLimits {
  std::optional<double> days;
  std::optional<double> gib;
};

class Upkeep {
 public:
  Upkeep(Database& database, std::size_t checkpoint_bytes);

  /// Deletes what outlived the `keep` of its run. True: there is more.
  bool expire_samples(WallTime now);
  /// Marks runs for removal. At most one for the file's size; call again when purge() is done.
  void retain(const RetentionLimits& limits, WallTime now);
  bool above(const RetentionLimits& limits) const;  ///< the file is larger than it may be
  /// Where the file is above its size and no ended run is left to remove, deletes the oldest block of a run that goes
  /// on. True: it did.
  bool trim(const RetentionLimits& limits);
  /// One small step of removing what is marked, or of giving pages back. True: there is more.
  bool purge();
  void forget_old_keys(WallTime now);
  /// Copies the write-ahead log into the file, above the limit or when idle. Never waits for a reader.
  void checkpoint(bool idle);
  bool removing() const;

 private:
  bool purge_run(RunId run);
  void expire_block(RunId run, std::int64_t block);
  static int count_pages(void* self, sqlite3*, const char*, int pages);

  Database& database_;
  const std::size_t checkpoint_bytes_;
  std::size_t page_size_;
  std::size_t log_pages_ = 0;
};

/// Bytes of the file that are in use.
std::int64_t used_bytes(const Database& database);

}  // namespace vigil
