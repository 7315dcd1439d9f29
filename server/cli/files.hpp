/// Files as the command line reads and writes them.
#pragma once

#include <string>

#include "engine/core/json.hpp"

namespace vigil {

/// The whole file. Throws UserError.
std::string read_text(const std::string& file);
/// Throws UserError naming the file and the byte where it is not JSON.
Json read_json(const std::string& file);
/// Writes the whole file anew, or standard output for "-". Throws UserError.
void write_text(const std::string& file, const std::string& text);

}  // namespace vigil
