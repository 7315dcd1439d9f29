#include "server/plant/credentials.hpp"

#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

#include "engine/core/describe.hpp"
#include "engine/core/json.hpp"

namespace vigil {
namespace {

constexpr std::size_t kLongest = 64 * 1024;

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::map<std::string, std::string> read_object(const std::string& text, const std::string& path) {
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) throw std::runtime_error(path + " is no JSON object");
  std::map<std::string, std::string> members;
  for (const auto& [name, value] : json.items()) {
    if (!value.is_string()) throw std::runtime_error(path + ": " + name + " is no text");
    members[name] = value.get<std::string>();
  }
  return members;
}

std::map<std::string, std::string> read_lines(const std::string& text, const std::string& path) {
  std::map<std::string, std::string> members;
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    line = trimmed(line);
    if (line.empty() || line[0] == '#') continue;
    const std::size_t equals = line.find('=');
    if (equals == std::string::npos)
      throw std::runtime_error(path + ": line " + std::to_string(number) + " is not name = value");
    members[trimmed(line.substr(0, equals))] = trimmed(line.substr(equals + 1));
  }
  return members;
}

}  // namespace

BrokerCredentials BrokerCredentials::from_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::string text(kLongest + 1, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(in.gcount()));
  if (in.bad() || !in.eof()) throw std::runtime_error("cannot read " + path);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  const bool object = first != std::string::npos && text[first] == '{';
  BrokerCredentials all;
  const std::map<std::string, std::string*> places{{"user", &all.user}, {"password", &all.password},
                                                   {"ca", &all.ca},     {"certificate", &all.certificate},
                                                   {"key", &all.key},   {"key_password", &all.key_password}};
  for (const auto& [name, value] : object ? read_object(text, path) : read_lines(text, path)) {
    const auto place = places.find(name);
    if (place == places.end())
      throw std::runtime_error(path + ": there is no " + in_quotes(name) +
                               "; expected user, password, ca, certificate, key, key_password");
    *place->second = value;
  }
  for (std::string* file : {&all.ca, &all.certificate, &all.key}) {
    if (file->empty()) continue;
    if ((*file)[0] != '/') *file = std::filesystem::path(path).parent_path() / *file;
    if (!std::ifstream(*file)) throw std::runtime_error(path + ": cannot read " + *file);
  }
  struct stat status {};
  all.open_to_others = ::stat(path.c_str(), &status) == 0 && (status.st_mode & (S_IRWXG | S_IRWXO)) != 0;
  return all;
}

}  // namespace vigil
