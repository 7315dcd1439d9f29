#include "server/cli/files.hpp"

#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

#include "server/cli/commands.hpp"

namespace vigil {

std::string read_text(const std::string& file) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) throw UserError(file + " is a folder; expected a file");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw UserError(file + " cannot be read");
  std::ostringstream text;
  text << stream.rdbuf();
  if (stream.bad()) throw UserError(file + " cannot be read");
  return std::move(text).str();
}

Json read_json(const std::string& file) {
  const std::string text = read_text(file);
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    throw UserError(file + " is not JSON: the error is at byte " + std::to_string(error.byte));
  } catch (const Json::exception&) {
    throw UserError(file + " holds a number that is not finite");
  }
}

void write_text(const std::string& file, const std::string& text) {
  if (file == "-") {
    std::cout << text << std::flush;
    return;
  }
  std::ofstream stream(file, std::ios::binary | std::ios::trunc);
  stream << text << std::flush;
  if (!stream) throw UserError(file + " cannot be written");
}

}  // namespace vigil
