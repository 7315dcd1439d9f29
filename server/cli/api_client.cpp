#include "server/cli/api_client.hpp"

#include <httplib.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "server/cli/commands.hpp"
#include "server/cli/files.hpp"

namespace vigil {
namespace {

constexpr const char* kBase = "/api/v1";
constexpr const char* kJson = "application/json";

/// The body of an answer that is none of a refusal.
std::string body_of(const httplib::Result& result) {
  if (!result) throw UserError("the server does not answer: " + httplib::to_string(result.error()));
  if (result->status / 100 == 2) return result->body;
  const Json problem = Json::parse(result->body, nullptr, false);
  if (!problem.is_object()) throw UserError("this is no server of Vigil");
  std::string sentence = problem.value("detail", "the server refused");
  if (const auto errors = problem.find("errors"); errors != problem.end() && errors->is_array() && !errors->empty())
    sentence = errors->front().value("pointer", "") + ": " + errors->front().value("detail", sentence);
  throw UserError(sentence);
}

Json json_of(const httplib::Result& result) {
  const std::string body = body_of(result);
  Json json = Json::parse(body, nullptr, false);
  if (json.is_discarded()) throw UserError("this is no server of Vigil");
  return json;
}

std::string at(const std::string& path) { return kBase + path; }

}  // namespace

void ServerAddress::add_to(CLI::App& command) {
  command.add_option("--server", server, "http://127.0.0.1:8080 without");
  command.add_option("--token-file", token_file, "first line: the token");
}

ApiClient::ApiClient(const ServerAddress& options) : client_(std::make_unique<httplib::Client>(options.server)) {
  if (!client_->is_valid() || !options.server.starts_with("http://"))
    throw UserError("--server is " + options.server + "; expected http://HOST:PORT");
  client_->set_read_timeout(60);
  if (options.token_file.empty()) return;
  const std::string text = read_text(options.token_file);
  client_->set_bearer_token_auth(text.substr(0, text.find_first_of("\r\n")).c_str());
}

ApiClient::~ApiClient() = default;

Json ApiClient::get(const std::string& path) { return json_of(client_->Get(at(path).c_str())); }
std::string ApiClient::get_text(const std::string& path) { return body_of(client_->Get(at(path).c_str())); }

Json ApiClient::post(const std::string& path, const Json& body) {
  return json_of(client_->Post(at(path).c_str(), body.dump(), kJson));
}

Json ApiClient::patch(const std::string& path, const Json& body) {
  return json_of(client_->Patch(at(path).c_str(), body.dump(), kJson));
}

void ApiClient::remove(const std::string& path) { body_of(client_->Delete(at(path).c_str(), std::string(), kJson)); }

Json ApiClient::post_csv(const std::string& path, const std::string& csv) {
  for (;;) {
    const auto result = client_->Post(at(path).c_str(), csv, "text/csv");
    if (!result || result->status != 429) return json_of(result);
    std::this_thread::sleep_for(std::chrono::seconds(1));
  }
}

std::string run_path(const std::string& run) {
  if (run.empty() || !std::all_of(run.begin(), run.end(), [](char c) { return c >= '0' && c <= '9'; }))
    throw UserError("RUN is " + run + "; expected a run's id");
  return "/runs/" + run;
}

}  // namespace vigil
