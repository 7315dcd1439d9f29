/// How fast a run goes: as fast as it can, or so many ticks per second of real time.
#pragma once

#include <optional>
#include <string>

#include "engine/core/json.hpp"

namespace vigil {

struct Pace {
  std::optional<double> ticks_per_second;  ///< empty: as fast as possible

  bool paced() const { return ticks_per_second.has_value(); }
  /// "max" or a number from 0.001 to 100000. Throws InputError at `pointer`.
  static Pace from_json(const Json& value, const std::string& pointer);
  Json to_json() const;
};

}  // namespace vigil
