/// --nats and --nats-credentials: what `campaign`, `worker` and `serve` share.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>

#include "server/crew/broker.hpp"

namespace vigil {

struct NatsFlags {
  NatsOptions options;

  /// Returns --nats itself.
  CLI::Option* add_to(CLI::App& command, const char* what);
  bool given() const { return !options.url.empty(); }
  /// Says what the broker does on standard error. Throws UserError where it cannot be used.
  std::unique_ptr<Broker> connect();
};

}  // namespace vigil
