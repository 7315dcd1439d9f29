/// Inside of RunManager: a run whose gains are not all known.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "server/runs/manager.hpp"
#include "server/synthesis/designer.hpp"

namespace vigil {

struct RunManager::Waiting {
  RunOrder order;
  std::vector<DesignTask> tasks;  ///< that are open
  Designer::Holder holder = 0;
  bool going_on = false;            ///< they are found: it is being made
  std::optional<std::string> stop;  ///< state it shall end in, asked for meanwhile
};

}  // namespace vigil
