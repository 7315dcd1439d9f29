#include "server/cli/mqtt_options.hpp"

#include <spdlog/spdlog.h>
#include <unistd.h>

#include <filesystem>

#include "db/writer.hpp"
#include "engine/core/describe.hpp"
#include "engine/core/input_error.hpp"
#include "server/cli/commands.hpp"

namespace vigil {

std::string server_name(const std::string& db) {
  char host[256] = {};
  gethostname(host, sizeof host - 1);
  std::error_code error;
  const std::string file = std::filesystem::weakly_canonical(db, error).string();
  std::string name = host[0] == '\0' ? "localhost" : host;
  for (char& c : name) {
    if (c == '/' || c == '+' || c == '#' || c == '.') c = '-';
  }
  return name + "-" + sha256_hex(file).substr(0, 8);
}

void MqttFlags::add_to(CLI::App& command) {
  CLI::Option* broker =
      command.add_option("--mqtt", url, "a broker, tcp://HOST:PORT or ssl://HOST:PORT: alarms go there");
  command
      .add_option("--mqtt-topic", topics,
                  "topics that feed runs, such as plant/{run}/{node}/{channel} or plant/{run}/rows; + and # as in MQTT")
      ->take_all()
      ->allow_extra_args(false)
      ->needs(broker);
  command
      .add_option("--mqtt-credentials", credentials,
                  "file of user, password, ca, certificate, key, key_password: JSON, or name = value a line")
      ->needs(broker);
  command.add_option("--mqtt-client", client, "name to the broker; without, of the host and the log")->needs(broker);
  command.add_option("--mqtt-prefix", prefix,
                     "what alarms and states are published under; vigil/NAME without; of NATS too, with dots");
}

std::optional<MqttOptions> MqttFlags::settle(const std::string& db) const {
  if (url.empty()) return std::nullopt;
  if (const std::string missing = mqtt_missing(); !missing.empty()) throw UserError("--mqtt: " + missing);
  MqttOptions options;
  options.url = url;
  options.client = client.empty() ? "vigil-" + server_name(db) : client;
  options.prefix = prefix_of(db);
  if (options.prefix.find_first_of("+#") != std::string::npos || options.prefix.ends_with('/') ||
      !is_utf8(options.prefix))
    throw UserError("--mqtt-prefix is " + in_quotes(prefix) + "; expected levels without + and #");
  try {
    check_mqtt(options);
    for (const std::string& topic : topics) options.topics.emplace_back(topic);
    if (!credentials.empty()) options.credentials = BrokerCredentials::from_file(credentials);
  } catch (const InputError& error) {
    throw UserError(std::string("--mqtt-topic: ") + error.what());
  } catch (const std::runtime_error& error) {
    throw UserError(std::string("--mqtt: ") + error.what());
  }
  if (options.credentials.open_to_others)
    spdlog::warn("{} can be read by other users of this machine (chmod 600 {})", credentials, credentials);
  return options;
}

}  // namespace vigil
