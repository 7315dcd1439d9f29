/// Is the log whole? Every table against every other.
#pragma once

#include "db/database.hpp"
#include "db/maintenance.hpp"

namespace vigil {

/// Reads everything in one transaction. At most 50 sentences of trouble; throws SqlError where pages cannot be read.
MaintenanceReport check_database(Database& database);

}  // namespace vigil
