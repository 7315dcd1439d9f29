/// What the files that set a run up share.
#pragma once

#include <fmt/format.h>

#include <string>

#include "engine/core/registry.hpp"

namespace vigil {

/// The registered entry of a document's type. Throws InputError at `pointer`.
template <class Make>
const Entry<Make>& entry_of(const std::string& type, const std::string& pointer) {
  const auto* entry = Registry<Make>::find(type);
  if (entry == nullptr) throw InputError(pointer, fmt::format("there is no \"{}\" here", type));
  return *entry;
}

}  // namespace vigil
