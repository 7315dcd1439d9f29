/// Reading something that a registry lists: its type or method, and its params by the declared table.
#pragma once

#include <string>
#include <vector>

#include "engine/core/describe.hpp"
#include "engine/core/registry.hpp"
#include "engine/scenario/fields.hpp"

namespace vigil::section {

/// Writes `key` ("type", "method") and "params" into `result`, completed by the entry's table. `kind` is for messages:
/// "plant".
template <class Make>
void complete_typed(Fields& fields, const std::string& key, const std::string& kind, Json& result,
                    std::vector<Problem>& problems) {
  const std::vector<std::string> ids = Registry<Make>::ids();
  if (!fields.has(key)) {
    fields.missing(key, "a " + kind + ": one of " + listed(ids));
    return;
  }
  const Json chosen = fields.choice(key, ids, "");
  const Entry<Make>* entry = Registry<Make>::find(chosen.get<std::string>());
  if (entry == nullptr) return;
  result[key] = chosen;
  const Json given = fields.has("params") ? fields.at("params") : Json::object();
  result["params"] = entry->params.complete(given, fields.pointer("params"), problems);
}

}  // namespace vigil::section
