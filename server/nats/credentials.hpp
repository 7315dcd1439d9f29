/// Who we are to the broker.
#pragma once

#include <nats/nats.h>

#include <string>
#include <vector>

namespace vigil {

/// files: as NatsOptions has them. Throws std::runtime_error with one sentence where one cannot be read or used.
void add_credentials(natsOptions* options, const std::vector<std::string>& files);

}  // namespace vigil
