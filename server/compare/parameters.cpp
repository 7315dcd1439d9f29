#include "server/compare/parameters.hpp"

#include <map>
#include <optional>

namespace vigil {
namespace {

void flatten(const Json& value, const std::string& path, std::map<std::string, Json>& into) {
  if (!value.is_object() || value.empty()) {
    into[path] = value;
    return;
  }
  for (const auto& [key, member] : value.items()) flatten(member, path.empty() ? key : path + "." + key, into);
}

bool same(const Json* a, const Json* b) { return a == b || (a != nullptr && b != nullptr && *a == *b); }

std::map<std::string, Json> members(const ComparedRun& run) {
  std::map<std::string, Json> all;
  if (run.document.is_object()) flatten(run.document, "", all);
  if (!run.input.is_null()) all["input"] = run.input;
  std::map<std::int64_t, int> count;
  for (const Command& command : run.live) {
    const std::string path = "commands." + std::to_string(command.k) + "." + std::to_string(count[command.k]++);
    flatten(command.body, path, all);
  }
  return all;
}

}  // namespace

Json differing_parameters(const std::vector<ComparedRun>& runs) {
  std::vector<std::map<std::string, Json>> documents;
  std::map<std::string, bool> paths;
  for (const ComparedRun& run : runs) {
    documents.push_back(members(run));
    for (const auto& [path, value] : documents.back()) paths[path] = true;
  }
  Json rows = Json::array();
  for (const auto& [path, there] : paths) {
    Json values = Json::array();
    std::optional<const Json*> known;  // a pointer to nothing: known not to be there
    bool differs = false;
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const auto place = documents[i].find(path);
      const Json* own = place == documents[i].end() ? nullptr : &place->second;
      values.push_back(own == nullptr ? Json() : *own);
      if (runs[i].document.is_null()) continue;
      if (!known) known = own;
      differs = differs || !same(*known, own);
    }
    if (differs) rows.push_back({{"path", path}, {"values", std::move(values)}});
  }
  return rows;
}

}  // namespace vigil
