#define VIGIL_INSTANCE template
#include "engine/linalg/instances.hpp"
