#include "server/ingest/plant_options.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/describe.hpp"
#include "engine/core/input_error.hpp"

namespace vigil {
namespace {

constexpr std::array kClocks{"k", "time", "arrival"};
constexpr std::size_t kLongestName = 200;
constexpr std::size_t kMostSignals = 10'000;

std::string read_name(const Json& value, const std::string& pointer) {
  const auto fits = [](unsigned char c) { return c > 0x20 && c != 0x7f && c != '/' && c != '+' && c != '#'; };
  const std::string name = value.is_string() ? value.get<std::string>() : "";
  if (name.empty() || name.size() > kLongestName || !std::all_of(name.begin(), name.end(), fits))
    throw InputError(pointer, "the name is " + shown(value) + "; expected one level of a topic",
                     "text without blanks, '/', '+' and '#'");
  return name;
}

PlantOptions::Clock read_clock(const Json& value, const std::string& pointer) {
  for (std::size_t i = 0; i < kClocks.size(); ++i) {
    if (value == kClocks[i]) return static_cast<PlantOptions::Clock>(i);
  }
  throw InputError(pointer, "clock is " + shown(value) + "; expected \"k\", \"time\" or \"arrival\"",
                   "\"k\", \"time\", \"arrival\"");
}

double read_seconds(const Json& value, const std::string& pointer, double most) {
  const double seconds = value.is_number() ? value.get<double>() : -1;
  if (!(seconds >= 0 && seconds <= most))
    throw InputError(pointer, shown(value) + " is no number of seconds from 0 to " + number_text(most),
                     "0 to " + number_text(most));
  return seconds;
}

std::map<std::string, std::string> read_signals(const Json& value, const std::string& pointer) {
  std::map<std::string, std::string> signals;
  if (!value.is_object() || value.size() > kMostSignals)
    throw InputError(pointer, "signals is " + shown(value) + "; expected the plant's names and the run's columns",
                     "object of texts");
  for (const auto& [name, column] : value.items()) {
    if (!column.is_string())
      throw InputError(child(pointer, name), "the column is " + shown(column) + "; expected a name", "text");
    signals[name] = column.get<std::string>();
  }
  return signals;
}

}  // namespace

PlantOptions PlantOptions::from_json(const Json& json, const std::string& pointer) {
  PlantOptions options;
  if (!json.is_object()) {
    options.name = read_name(json, pointer);
    return options;
  }
  for (const auto& [key, value] : json.items()) {
    const std::string at = child(pointer, key);
    if (key == "name")
      options.name = read_name(value, at);
    else if (key == "clock")
      options.clock = read_clock(value, at);
    else if (key == "hold")
      options.hold = read_seconds(value, at, 1e9);
    else if (key == "start")
      options.start = read_seconds(value, at, 1e12);
    else if (key == "signals")
      options.signals = read_signals(value, at);
    else
      throw InputError(at, "there is no " + in_quotes(key) + " here", "name, clock, hold, start, signals");
  }
  if (options.name.empty())
    throw InputError(pointer + "/name", "name is missing; expected one level of a topic", "text");
  return options;
}

Json PlantOptions::to_json() const {
  Json json{{"name", name}, {"clock", kClocks[static_cast<std::size_t>(clock)]}};
  if (hold > 0) json["hold"] = hold;
  if (start) json["start"] = *start;
  if (!signals.empty()) json["signals"] = signals;
  return json;
}

}  // namespace vigil
