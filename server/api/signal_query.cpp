#include "server/api/signal_query.hpp"

#include <algorithm>
#include <charconv>
#include <string>

#include "engine/core/describe.hpp"
#include "engine/core/params.hpp"
#include "server/front/message.hpp"
#include "server/runs/glob.hpp"

namespace vigil {
namespace {

bool is_number(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

bool is_id(std::string_view text, int id) {
  int value = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && value == id;
}

[[noreturn]] void refuse(std::string_view part, const std::vector<Signal>& signals) {
  std::vector<std::string> names;
  for (const Signal& signal : signals) names.push_back(signal.name);
  const std::string near = nearest(part, names);
  const std::string detail = "No signal of this run is called, or fits, " + in_quotes(part) +
                             (near.empty() ? std::string() : "; did you mean " + in_quotes(near) + "?");
  throw HttpError(400, detail, {{"/signals", detail, "names, patterns with * and ?, or ids of GET …/signals"}});
}

}  // namespace

std::vector<int> pick_signals(std::string_view wanted, const std::vector<Signal>& signals) {
  std::vector<int> picked;
  std::vector<bool> taken(signals.size(), false);
  if (wanted.empty()) wanted = "*";
  while (!wanted.empty()) {
    const std::size_t comma = wanted.find(',');
    const std::string_view part = wanted.substr(0, comma);
    wanted.remove_prefix(comma == std::string_view::npos ? wanted.size() : comma + 1);
    bool found = false;
    for (std::size_t i = 0; i < signals.size(); ++i) {
      const bool fits = is_number(part) ? is_id(part, signals[i].id) : glob_match(part, signals[i].name);
      found = found || fits;
      if (!fits || taken[i]) continue;
      taken[i] = true;
      picked.push_back(signals[i].id);
    }
    if (!found) refuse(part, signals);
  }
  return picked;
}

}  // namespace vigil
