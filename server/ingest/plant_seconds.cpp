#include <cmath>
#include <cstdio>
#include <ctime>

#include "server/ingest/plant_reader.hpp"

namespace vigil {
namespace {

/// "2026-03-01T12:00:00.25Z", "…+02:00", without a zone UTC.
std::optional<double> read_iso(const std::string& text) {
  int year = 0, month = 0, day = 0, hour = 0, minute = 0, read = 0;
  double second = 0;
  if (text.size() > 40 ||
      std::sscanf(text.c_str(), "%4d-%2d-%2d%*1[T ]%2d:%2d:%n", &year, &month, &day, &hour, &minute, &read) != 5 ||
      read == 0)
    return std::nullopt;
  const char* const rest = text.c_str() + read;
  if (*rest < '0' || *rest > '9' || std::sscanf(rest, "%lf%n", &second, &read) != 1) return std::nullopt;
  const std::string zone = rest + read;
  std::tm calendar{};
  calendar.tm_year = year - 1900;
  calendar.tm_mon = month - 1;
  calendar.tm_mday = day;
  const bool fits = month >= 1 && month <= 12 && day >= 1 && day <= 31 && hour >= 0 && hour <= 24 && minute >= 0 &&
                    minute <= 59 && second >= 0 && second < 61;
  if (!fits) return std::nullopt;
  const double at = static_cast<double>(timegm(&calendar)) + 3600.0 * hour + 60.0 * minute + second;
  if (zone.empty() || zone == "Z" || zone == "z") return at;
  int hours = 0, minutes = 0, length = 0;
  if ((zone[0] != '+' && zone[0] != '-') ||
      std::sscanf(zone.c_str() + 1, "%2d:%2d%n", &hours, &minutes, &length) != 2 ||
      static_cast<std::size_t>(length) + 1 != zone.size() || hours < 0 || minutes < 0)
    return std::nullopt;
  return at - (zone[0] == '+' ? 1 : -1) * (3600.0 * hours + 60.0 * minutes);
}

}  // namespace

std::optional<double> plant_seconds(const Json& value) {
  if (value.is_string()) return read_iso(value.get<std::string>());
  if (!value.is_number()) return std::nullopt;
  const double number = value.get<double>();
  if (!std::isfinite(number) || number < 0) return std::nullopt;
  if (number > 1e17) return number / 1e9;
  if (number > 1e14) return number / 1e6;
  return number > 1e11 ? number / 1e3 : number;
}

}  // namespace vigil
