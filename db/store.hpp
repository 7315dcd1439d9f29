/// The SQL of single rows, inside the caller's transaction. Throws SqlError, and LogError where the row is not there.
#pragma once

#include "db/database.hpp"
#include "db/records.hpp"
#include "db/sealer.hpp"

namespace vigil {

/// One line of JSON; what is not UTF-8 is replaced, non-finite numbers are null.
std::string dump(const Json& json);

RunId insert_run(Database& database, const RunRecord& record, WallTime now);
void apply_update(Database& database, RunId run, const RunUpdate& update);
void insert_signals(Database& database, RunId run, const std::vector<Signal>& all, const std::vector<int>& logged,
                    std::int64_t every, LogPolicy policy, double dt);
void insert_mark(Database& database, RunId run, const Mark& mark);
void insert_command(Database& database, RunId run, const Command& command);
void insert_gap(Database& database, RunId run, const GapRow& gap);
void insert_block(Database& database, const SealedBlock& block, WallTime now);
void insert_tail(Database& database, const TailRow& row);
void set_newest(Database& database, RunId run, std::int64_t k);
/// The run that the key made in the last 24 hours. Throws LogError (conflict) where it came with another body.
std::optional<RunId> known_key(Database& database, const RunRecord& record, WallTime now);

}  // namespace vigil
