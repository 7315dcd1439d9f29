#include "engine/papers/chinese.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <vector>

#include "engine/papers/chinese_phrases.hpp"

namespace vigil::papers {
namespace {

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }
bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

/// The text with # for every number that does not belong to a word, and these numbers.
std::pair<std::string, std::vector<std::string>> without_numbers(std::string_view text) {
  std::pair<std::string, std::vector<std::string>> result;
  for (std::size_t at = 0; at < text.size();) {
    if (!is_digit(text[at]) || (at > 0 && is_word(text[at - 1]))) {
      result.first += text[at++];
      continue;
    }
    const std::size_t begin = at;
    while (at < text.size() &&
           (is_digit(text[at]) || (text[at] == '.' && at + 1 < text.size() && is_digit(text[at + 1]))))
      ++at;
    result.first += '#';
    result.second.emplace_back(text.substr(begin, at - begin));
  }
  return result;
}

const std::map<std::string_view, std::string_view>& catalogue() {
  static const std::map<std::string_view, std::string_view> all = [] {
    std::map<std::string_view, std::string_view> map;
    for (const auto& phrases : {claim_phrases(), figure_phrases()}) map.insert(phrases.begin(), phrases.end());
    return map;
  }();
  return all;
}

/// A lane, a component, an index: not a word of English, so the same in both.
bool is_name(std::string_view text) {
  const bool plain = std::all_of(text.begin(), text.end(), [](char c) { return is_word(c) || c == '-' || c == '.'; });
  const bool marked = std::any_of(text.begin(), text.end(), [](char c) { return c == '_' || is_digit(c); });
  return text.empty() || (plain && (marked || text.size() == 1));
}

std::string phrase(std::string_view english) {
  const auto [pattern, numbers] = without_numbers(english);
  const auto place = catalogue().find(pattern);
  if (place == catalogue().end()) return is_name(english) ? std::string(english) : "";
  std::string text(place->second);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::string mark = "{" + std::to_string(i + 1) + "}";
    for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at))
      text.replace(at, mark.size(), numbers[i]);
  }
  return text;
}

/// Whether a comma or a colon with a space behind it stands here.
bool breaks(std::string_view text, std::size_t at) {
  return at + 1 < text.size() && (text[at] == ',' || text[at] == ':') && text[at + 1] == ' ';
}

}  // namespace

const ItemWords* chinese_words(std::string_view key) {
  for (const auto& words : {plant_items_words(), replay_items_words(), privacy_items_words()}) {
    for (const KeyedWords& one : words) {
      if (one.key == key) return &one.words;
    }
  }
  return nullptr;
}

std::string chinese(std::string_view english) {
  if (std::string whole = phrase(english); !whole.empty() || english.empty()) return whole;
  int depth = 0;
  for (std::size_t at = 0; at < english.size(); ++at) {
    depth += english[at] == '(' ? 1 : english[at] == ')' ? -1 : 0;
    if (depth != 0 || !breaks(english, at)) continue;
    const std::string first = phrase(english.substr(0, at)), rest = chinese(english.substr(at + 2));
    if (at == 0) return rest;
    if (!first.empty() && !rest.empty()) return first + (english[at] == ',' ? "，" : "：") + rest;
  }
  return "";
}

}  // namespace vigil::papers
