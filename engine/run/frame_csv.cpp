#include "engine/run/frame_csv.hpp"

#include <charconv>
#include <cmath>

namespace vigil {
namespace {

template <class Number>
void append(std::string& out, Number value) {
  char buffer[32];
  out.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
}

}  // namespace

std::string csv_header(const Catalogue& catalogue) {
  std::string header = "k,t";
  for (const auto& signal : catalogue.all()) header += "," + signal.name;
  return header + "\n";
}

void append_csv_row(std::string& out, const Frame& frame) {
  append(out, frame.k);
  out += ',';
  append(out, frame.t);
  for (const double value : frame.values) {
    out += ',';
    if (std::isfinite(value)) append(out, value);
  }
  out += '\n';
}

}  // namespace vigil
