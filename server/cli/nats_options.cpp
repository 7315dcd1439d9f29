#include "server/cli/nats_options.hpp"

#include <iostream>

#include "server/cli/commands.hpp"

namespace vigil {

CLI::Option* NatsFlags::add_to(CLI::App& command, const char* what) {
  options.say = [](const std::string& sentence) { std::cerr << "vigil: " + sentence + "\n" << std::flush; };
  CLI::Option* url = command.add_option("--nats", options.url, what);
  command
      .add_option("--nats-credentials", options.credentials,
                  "a file of NATS credentials (or two: user and seed), or JSON with user, password, token, ca, "
                  "certificate, key")
      ->expected(1, 2)
      ->needs(url);
  return url;
}

std::unique_ptr<Broker> NatsFlags::connect() {
  try {
    return connect_nats(options);
  } catch (const std::runtime_error& error) {
    throw UserError(std::string("--nats: ") + error.what());
  }
}

}  // namespace vigil
