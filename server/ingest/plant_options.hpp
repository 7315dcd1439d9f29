/// How a run listens to a plant that speaks in topics.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "engine/core/json.hpp"

namespace vigil {

struct PlantOptions {
  enum class Clock {
    ticks,   ///< messages say k
    time,    ///< messages say when, in s or ms since any beginning, or as ISO 8601
    arrival  ///< they say nothing: a value is of the tick in which it came
  };
  std::string name;  ///< of the run in topics, beside its id
  Clock clock = Clock::ticks;
  double hold = 0;              ///< s, of the clock "arrival": how long a value stands for later ticks
  std::optional<double> start;  ///< s, of the clock "time": when tick 0 is; else the first message's time
  std::map<std::string, std::string> signals;  ///< the plant's names to columns of the run

  /// A name alone, or {"name","clock","hold","start","signals"}. Throws InputError below `pointer`.
  static PlantOptions from_json(const Json& json, const std::string& pointer);
  Json to_json() const;
};

}  // namespace vigil
