/// `vigil db`: check, backup, prune, vacuum.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "db/records.hpp"

namespace vigil {

struct MaintenanceReport {
  bool ok = true;
  std::vector<std::string> sentences;  ///< for a person, in order
  std::int64_t runs = 0;
  std::int64_t blocks = 0;
  std::int64_t chunks = 0;
  std::int64_t bytes_before = 0;
  std::int64_t bytes_after = 0;
};

/// SQLite's integrity and foreign keys; every chunk decodes and its CRC and rollup agree; every run's blocks, gaps and
/// tail join without a hole. Reads only: may run beside a server. Throws LogError (unusable, missing file).
MaintenanceReport check_log(const std::string& path);
/// Copies a log that may be in use to a new file and checks the copy. Throws LogError where the target exists or cannot
/// be written.
MaintenanceReport backup_log(const std::string& path, const std::string& target);
/// Removes finished runs that ended more than `days` ago and are not tagged `keep`. Needs the file for itself.
MaintenanceReport prune_log(const std::string& path, double days, const std::function<WallTime()>& clock = {});
/// Gives unused pages back to the file system. Needs the file for itself.
MaintenanceReport vacuum_log(const std::string& path);

}  // namespace vigil
