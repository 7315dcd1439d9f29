/// --mqtt and what belongs to it: options of `serve`.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "server/plant/mqtt.hpp"

namespace vigil {

/// What tells this host's servers apart, the same again after a restart: the host's name, and a hash of the log's path.
std::string server_name(const std::string& db);

struct MqttFlags {
  std::string url, credentials, client, prefix;
  std::vector<std::string> topics;

  void add_to(CLI::App& command);
  /// Empty where no broker was named. `db` is the log's file. Throws UserError.
  std::optional<MqttOptions> settle(const std::string& db) const;
  /// What alarms and states of this server are published under: --mqtt-prefix, else vigil/<server_name()>.
  std::string prefix_of(const std::string& db) const { return prefix.empty() ? "vigil/" + server_name(db) : prefix; }
};

}  // namespace vigil
