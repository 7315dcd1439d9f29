/// The whole server: log, hub, runs, routes and front, put together in the order they need.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "db/writer.hpp"
#include "server/api/services.hpp"
#include "server/crew/broker.hpp"
#include "server/front/front.hpp"
#include "server/hub/hub.hpp"
#include "server/plant/outside.hpp"
#include "server/runs/manager.hpp"

namespace vigil {

struct ServerOptions {
  FrontOptions front;
  HubOptions hub;
  ManagerOptions runs;
  LogOptions log;
  std::string db = "vigil.db";
  NatsOptions nats;                          ///< an empty URL: no broker
  std::optional<MqttOptions> mqtt;           ///< empty: no broker
  std::string nats_prefix = "vigil";         ///< of the subjects that alarms go out under
  std::optional<std::filesystem::path> web;  ///< the page's files; empty: a plain page says how to build them
  bool demo = true;
};

class Server {
 public:
  /// Opens the log. Throws LogError; std::runtime_error where the page's files cannot be read, InputError where the
  /// broker's options cannot be used.
  explicit Server(ServerOptions options);
  ~Server();  ///< stops
  /// Listens, then starts the demo. Throws std::runtime_error if the port cannot be had.
  void start();
  int port() const;
  /// Runs that have begun become "stopped" with their metrics, those that wait "interrupted"; the log is closed
  /// cleanly.
  void stop();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vigil
