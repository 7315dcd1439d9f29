/// A server that goes on, as the commands see it that speak to one.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <string>

#include "engine/core/json.hpp"

namespace httplib {
class Client;
class Result;
}  // namespace httplib

namespace vigil {

struct ServerAddress {
  std::string server = "http://127.0.0.1:8080", token_file;
  /// --server and --token-file.
  void add_to(CLI::App& command);
};

/// Paths stand below /api/v1. Every call throws UserError with the server's own sentence where it refuses, or where
/// there is none.
class ApiClient {
 public:
  /// Throws UserError for an address that is none, or a token file that cannot be read.
  explicit ApiClient(const ServerAddress& options);
  ~ApiClient();

  Json get(const std::string& path);
  std::string get_text(const std::string& path);
  Json post(const std::string& path, const Json& body);
  Json patch(const std::string& path, const Json& body);
  void remove(const std::string& path);
  /// Sent again as often as the server says that it is behind (429).
  Json post_csv(const std::string& path, const std::string& csv);

 private:
  std::unique_ptr<httplib::Client> client_;
};

/// "/runs/<id>". Throws UserError for what is no run's id.
std::string run_path(const std::string& run);

}  // namespace vigil
