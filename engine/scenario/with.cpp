/// One dotted path set in a document.
#include <charconv>
#include <utility>

#include "engine/core/describe.hpp"
#include "engine/core/expectation.hpp"
#include "engine/scenario/scenario.hpp"
#include "engine/scenario/structure.hpp"

namespace vigil {
namespace {

std::vector<std::string> split(std::string_view path) {
  std::vector<std::string> parts;
  for (;;) {
    const std::size_t dot = path.find('.');
    parts.emplace_back(path.substr(0, dot));
    if (dot == std::string_view::npos) return parts;
    path.remove_prefix(dot + 1);
  }
}

/// Members that a complete document may lack: everything else that a path can lead to is there.
bool may_be_added(const std::vector<std::string>& parts, std::size_t depth) {
  const std::string& first = parts.front();
  if (first == "view") return depth > 0;
  if (first == "network") return depth == 1 && parts[1] == "edges";
  if (first == "metrics") return depth == 1 && parts[1] == "window";
  return first == "initial" && depth == 2 && parts[1] == "estimates";
}

std::vector<std::string> keys(const Json& object) {
  std::vector<std::string> result;
  for (const auto& [key, value] : object.items()) result.push_back(key);
  return result;
}

[[noreturn]] void leads_nowhere(const std::string& detail, const std::string& pointer, const std::string& allowed) {
  throw InputError(pointer, detail, allowed);
}

Json& array_entry(Json& array, const std::string& part, const std::string& pointer) {
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), index);
  const bool whole = error == std::errc() && end == part.data() + part.size();
  if (!whole || index >= array.size()) {
    const std::string allowed = array.empty() ? "nothing, it is empty" : "0 to " + std::to_string(array.size() - 1);
    leads_nowhere("the path leads nowhere: " + in_quotes(part) + " is no index here; expected " + allowed,
                  child(pointer, part), allowed);
  }
  return array[index];
}

/// One step down; makes a member that may be added.
Json& step(Json& here, const std::vector<std::string>& parts, std::size_t depth, const std::string& pointer) {
  const std::string& part = parts[depth];
  if (here.is_array()) return array_entry(here, part, pointer);
  const bool open = may_be_added(parts, depth) && !part.empty();
  if (here.is_null() && open) here = Json::object();
  if (!here.is_object()) {
    leads_nowhere("the path leads nowhere: there is only " + shown(here) + " above " + in_quotes(part),
                  child(pointer, part), "");
  }
  if (here.contains(part) || open) return here[part];
  Problem problem = unknown_key(part, keys(here), pointer);
  leads_nowhere("the path leads nowhere: " + problem.detail, problem.pointer, problem.allowed);
}

}  // namespace

Scenario Scenario::with(std::string_view dotted_path, const Json& value) const {
  constexpr std::size_t kLongestPath = 512;
  std::vector<Problem> problems;
  check_structure(value, "", problems);
  if (!problems.empty()) throw InputError(std::move(problems));
  if (dotted_path.size() > kLongestPath) throw InputError("", "the path has more than 512 characters", "a dotted path");
  const std::vector<std::string> parts = split(dotted_path);
  Json changed = document_;
  Json* here = &changed;
  std::string pointer;
  for (std::size_t depth = 0; depth < parts.size(); ++depth) {
    here = &step(*here, parts, depth, pointer);
    pointer = child(pointer, parts[depth]);
  }
  *here = value;
  return from_json(changed);
}

}  // namespace vigil
