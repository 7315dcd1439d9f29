#include "engine/world/plant.hpp"

#include <cmath>

namespace vigil {

double wrap(double value, double period) {
  if (period == 0) return value;
  return value - period * std::floor(value / period + 0.5);
}

}  // namespace vigil
