#include "server/runs/pace.hpp"

#include "engine/core/describe.hpp"
#include "engine/core/input_error.hpp"

namespace vigil {

Pace Pace::from_json(const Json& value, const std::string& pointer) {
  if (value == "max") return {};
  const bool number = value.is_number();
  const double rate = number ? value.get<double>() : 0;
  if (!number || !(rate >= 0.001 && rate <= 100'000)) {
    throw InputError(pointer, "pace is " + shown(value) + "; expected \"max\" or ticks per second from 0.001 to 100000",
                     "\"max\" or 0.001 to 100000");
  }
  return {rate};
}

Json Pace::to_json() const { return ticks_per_second ? Json(*ticks_per_second) : Json("max"); }

}  // namespace vigil
