#include "server/nats/credentials.hpp"

#include <fstream>
#include <sstream>
#include <stdexcept>

#include "engine/core/describe.hpp"
#include "engine/core/json.hpp"

namespace vigil {
namespace {

constexpr std::size_t kLargest = 1 << 20;

[[noreturn]] void refuse(const std::string& file, const std::string& why) {
  throw std::runtime_error("the credentials " + in_quotes(file) + " " + why);
}

std::string read(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in || text.str().size() > kLargest) refuse(file, "cannot be read");
  return text.str();
}

std::string member(const Json& json, const char* name, const std::string& file) {
  if (!json.contains(name)) return {};
  if (!json.at(name).is_string()) refuse(file, std::string("have no text as ") + name);
  return json.at(name).get<std::string>();
}

void demand(natsStatus status, const std::string& file) {
  if (status != NATS_OK) refuse(file, std::string("cannot be used: ") + natsStatus_GetText(status));
}

void add_members(natsOptions* options, const Json& json, const std::string& file) {
  for (const auto& [name, value] : json.items()) {
    const bool known = name == "user" || name == "password" || name == "token" || name == "ca" ||
                       name == "certificate" || name == "key";
    if (!known) refuse(file, "have " + in_quotes(name) + "; expected user, password, token, ca, certificate or key");
  }
  const std::string user = member(json, "user", file), token = member(json, "token", file);
  if (!user.empty())
    demand(natsOptions_SetUserInfo(options, user.c_str(), member(json, "password", file).c_str()), file);
  if (!token.empty()) demand(natsOptions_SetToken(options, token.c_str()), file);
  const std::string ca = member(json, "ca", file), certificate = member(json, "certificate", file);
  if (!ca.empty()) demand(natsOptions_LoadCATrustedCertificates(options, ca.c_str()), file);
  if (!certificate.empty()) {
    const std::string key = member(json, "key", file);
    demand(natsOptions_LoadCertificatesChain(options, certificate.c_str(), key.c_str()), file);
  }
}

}  // namespace

void add_credentials(natsOptions* options, const std::vector<std::string>& files) {
  if (files.empty()) return;
  if (files.size() > 2) throw std::runtime_error("there are more than two files of credentials");
  const std::string first = read(files.front());
  if (files.size() == 1) {
    const Json json = Json::parse(first, nullptr, false);
    if (json.is_object()) return add_members(options, json, files.front());
    if (first.find("-----BEGIN") == std::string::npos)
      refuse(files.front(), "are neither a JSON object nor a file of NATS credentials");
  } else {
    read(files.back());
  }
  const char* seed = files.size() == 2 ? files.back().c_str() : nullptr;
  demand(natsOptions_SetUserCredentialsFromFiles(options, files.front().c_str(), seed), files.front());
}

}  // namespace vigil
