/// Frame files: the same format a trace is read from.
#pragma once

#include <string>

#include "engine/run/frame.hpp"

namespace vigil {

/// "k,t,<names>\n"
std::string csv_header(const Catalogue& catalogue);
/// Appends one row at 17 significant digits (the shortest text that reads back to the same bits); NaN is an empty cell.
void append_csv_row(std::string& out, const Frame& frame);

}  // namespace vigil
