// What is said where NATS' library was not there at the build.
#include <stdexcept>

#include "server/crew/broker.hpp"

namespace vigil {
namespace {

[[noreturn]] void refuse() {
  throw std::runtime_error(
      "this vigil was built without NATS; install libnats-dev (Debian) and build again with -DVIGIL_NATS=ON");
}

}  // namespace

std::unique_ptr<Broker> connect_nats(const NatsOptions& /*options*/) { refuse(); }

void run_nats_worker(const WorkerOptions& /*options*/, const std::atomic<bool>& /*stop*/) { refuse(); }

}  // namespace vigil
