/// The tables of the log, and how an older file becomes a newer one.
#pragma once

#include <memory>
#include <string>

#include "db/database.hpp"

namespace vigil {

inline constexpr int kSchemaVersion = 4;
inline constexpr int kBlockRows = 512;  ///< rows in a sealed block
inline constexpr int kTimeSignal = -1;  ///< stands for t in table chunk, where t is not k * dt or rows are missing

/// Brings an open, writable file to kSchemaVersion. Throws LogError (unusable): another program's file, or a newer
/// schema.
void migrate(Database& database, const std::string& path);
/// Throws LogError (unusable) unless the file is a log of exactly kSchemaVersion.
void require_schema(const Database& database, const std::string& path);
/// Opens read-only with the schema checked. Throws LogError.
std::unique_ptr<Database> open_for_reading(const std::string& path);
/// Opens for the only writer: WAL, FULL, own checkpoints, migrated, quick-checked. Throws LogError.
std::unique_ptr<Database> open_for_writing(const std::string& path);

}  // namespace vigil
