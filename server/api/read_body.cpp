#include "server/api/read_body.hpp"

#include <algorithm>
#include <charconv>

#include "engine/core/describe.hpp"
#include "engine/core/expectation.hpp"
#include "engine/scenario/structure.hpp"

namespace vigil {

void check_members(const Json& body, const std::vector<std::string>& known) {
  std::vector<Problem> problems;
  check_structure(body, "", problems);
  for (const auto& [key, value] : body.items()) {
    if (std::find(known.begin(), known.end(), key) == known.end()) problems.push_back(unknown_key(key, known, ""));
  }
  if (!problems.empty()) throw InputError(std::move(problems));
}

std::vector<std::string> read_tags(const Json& value) {
  const auto fits = [](const Json& tag) {
    return tag.is_string() && !tag.get_ref<const std::string&>().empty() &&
           tag.get_ref<const std::string&>().size() <= 64;
  };
  if (!value.is_array() || value.size() > 32 || !std::all_of(value.begin(), value.end(), fits)) {
    throw InputError("/tags", "tags is " + shown(value) + "; expected up to 32 texts of 1 to 64 bytes",
                     "array of texts");
  }
  auto tags = value.get<std::vector<std::string>>();
  std::vector<std::string> unique;
  for (std::string& tag : tags) {
    if (std::find(unique.begin(), unique.end(), tag) == unique.end()) unique.push_back(std::move(tag));
  }
  return unique;
}

std::string read_note(const Json& value) {
  if (!value.is_string() || value.get_ref<const std::string&>().size() > 4000) {
    throw InputError("/note", "note is " + shown(value) + "; expected a text of at most 4000 bytes", "text");
  }
  return value.get<std::string>();
}

std::int64_t read_integer(const Json& value, const std::string& key, std::int64_t lo, std::int64_t hi) {
  const std::string range = std::to_string(lo) + " to " + std::to_string(hi);
  const bool fits = value.is_number_unsigned() ? value.get<std::uint64_t>() <= static_cast<std::uint64_t>(hi)
                                               : value.is_number_integer() && value.get<std::int64_t>() <= hi;
  if (!fits || value.get<std::int64_t>() < lo) {
    throw InputError(child("", key), key + " is " + shown(value) + "; expected an integer from " + range, range);
  }
  return value.get<std::int64_t>();
}

std::int64_t read_id(const Json& value, const std::string& pointer) {
  if (value.is_number_unsigned() && value.get<std::uint64_t>() <= kLargestSeed) return value.get<std::int64_t>();
  if (value.is_string()) {
    const auto& text = value.get_ref<const std::string&>();
    std::int64_t id = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), id);
    if (error == std::errc() && end == text.data() + text.size() && id >= 0) return id;
  }
  throw InputError(pointer, "the id is " + shown(value) + "; expected the id of a trace", "an id, as text");
}

void rethrow_below(const InputError& error, const std::string& head) {
  std::vector<Problem> problems = error.problems();
  for (Problem& problem : problems) problem.pointer = head + problem.pointer;
  throw InputError(std::move(problems));
}

Scenario named_scenario(const Services& services, const std::string& id) {
  if (Scenario::is_preset(id)) return Scenario::preset(id);
  if (const auto row = services.reader.scenario(id)) return Scenario::from_json(row->document);
  throw HttpError(404, "There is no scenario " + in_quotes(id) + "; GET /api/v1/scenarios lists them.");
}

void read_idempotency(const HttpRequest& request, RunOrder& order) {
  const std::string key = request.header("Idempotency-Key");
  if (key.empty()) return;
  const auto printable = [](char c) { return c >= 0x20 && c < 0x7f; };
  if (key.size() > 255 || !std::all_of(key.begin(), key.end(), printable)) {
    throw HttpError(400, "Idempotency-Key must be 1 to 255 printable ASCII characters.");
  }
  order.idempotency_key = key;
  order.idempotency_hash = sha256_hex(request.path + "\n" + request.body);
}

}  // namespace vigil
