#include "server/api/trial_command.hpp"

#include <algorithm>
#include <cctype>
#include <optional>

namespace vigil {
namespace {

constexpr std::size_t kMostSets = 12;  // more of them read worse than a patch

/// The JSON Merge Patch that makes `to` of `from`.
Json merge_patch(const Json& from, const Json& to) {
  Json patch = Json::object();
  for (const auto& [key, value] : from.items()) {
    if (!to.contains(key)) patch[key] = nullptr;
  }
  for (const auto& [key, value] : to.items()) {
    const auto old = from.find(key);
    if (old != from.end() && *old == value) continue;
    patch[key] = old != from.end() && old->is_object() && value.is_object() ? merge_patch(*old, value) : value;
  }
  return patch;
}

/// Each leaf of a patch as PATH=JSON; false where one of them is no member of the document that --set could reach.
bool sets_of(const Json& patch, const Json& from, const std::string& before, std::vector<std::string>& sets) {
  for (const auto& [key, value] : patch.items()) {
    if (value.is_null() || !from.contains(key) || key.find('.') != std::string::npos) return false;
    const std::string path = before.empty() ? key : before + "." + key;
    if (value.is_object() && from.at(key).is_object()) {
      if (!sets_of(value, from.at(key), path, sets)) return false;
    } else {
      sets.push_back(path + "=" + value.dump());
    }
  }
  return true;
}

/// As a patch of its preset; empty where it is no preset's, or a patch cannot say it (the order of members is meaning).
std::optional<Json> patch_of(const Scenario& scenario) {
  if (!Scenario::is_preset(scenario.id())) return std::nullopt;
  const Scenario preset = Scenario::preset(scenario.id());
  Json patch = merge_patch(preset.document(), scenario.document());
  if (preset.patched(patch).document().dump() != scenario.document().dump()) return std::nullopt;
  return patch;
}

std::string from_input(const Json& json, const std::string& rest) {
  return "echo " + shell_word(json.dump()) + " | vigil run " + rest;
}

}  // namespace

std::string shell_word(const std::string& text) {
  const auto plain = [](unsigned char c) {
    return std::isalnum(c) != 0 || std::string_view("_@%+=:,./-").find(static_cast<char>(c)) != std::string_view::npos;
  };
  if (!text.empty() && std::all_of(text.begin(), text.end(), plain)) return text;
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? "'\\''" : std::string(1, c);
  return word + "'";
}

std::string run_command(const Scenario& scenario, std::uint64_t seed, const std::string& trace_file) {
  std::string rest = " --seed " + std::to_string(seed);
  if (!trace_file.empty()) rest += " --trace " + shell_word(trace_file);
  const auto patch = patch_of(scenario);
  if (!patch) return from_input(scenario.document(), "/dev/stdin" + rest);
  std::vector<std::string> sets;
  if (!sets_of(*patch, Scenario::preset(scenario.id()).document(), "", sets) || sets.size() > kMostSets)
    return from_input(*patch, scenario.id() + rest + " --patch /dev/stdin");
  std::string line = "vigil run " + scenario.id() + rest;
  for (const std::string& set : sets) line += " --set " + shell_word(set);
  return line;
}

}  // namespace vigil
