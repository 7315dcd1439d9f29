#include "server/plant/topic_pattern.hpp"

#include <algorithm>

#include "engine/core/describe.hpp"
#include "engine/core/input_error.hpp"

namespace vigil {
namespace {

[[noreturn]] void refuse(const std::string& text, const std::string& why) {
  throw InputError("", "the topic " + in_quotes(text) + " " + why, "levels of text, +, {run}, {node}, {channel}, #");
}

std::vector<std::string> split(std::string_view text) {
  std::vector<std::string> levels;
  for (std::size_t at = 0;;) {
    const std::size_t end = std::min(text.find('/', at), text.size());
    levels.emplace_back(text.substr(at, end - at));
    if (end == text.size()) return levels;
    at = end + 1;
  }
}

}  // namespace

TopicPattern::Level TopicPattern::read_level(const std::string& text, const std::string& whole) {
  Level level;
  if (text == "+") {
    level.part = Part::any;
  } else if (text == "#") {
    level.part = Part::rest;
  } else if (const std::size_t open = text.find('{'); open != std::string::npos) {
    const std::size_t close = text.find('}', open);
    if (close == std::string::npos) refuse(whole, "has a { without its }");
    const std::string name = text.substr(open + 1, close - open - 1);
    if (name != "run" && name != "node" && name != "channel")
      refuse(whole, "has {" + name + "}; there are {run}, {node} and {channel}");
    level.part = name == "run" ? Part::run : (name == "node" ? Part::node : Part::channel);
    level.before = text.substr(0, open);
    level.after = text.substr(close + 1);
  } else {
    level.before = text;
  }
  if ((level.before + level.after).find_first_of("{}+#") != std::string::npos)
    refuse(whole, "has a level " + in_quotes(text) + "; expected a text, one place, + or #");
  return level;
}

TopicPattern::TopicPattern(const std::string& text) : text_(text) {
  const bool clean = std::all_of(text.begin(), text.end(), [](unsigned char c) { return c >= 0x20 && c != 0x7f; });
  if (text.empty() || text.size() > 1000 || !clean || !is_utf8(text)) refuse(text, "is none");
  for (const std::string& level : split(text)) levels_.push_back(read_level(level, text));
  check();
}

void TopicPattern::check() const {
  for (std::size_t i = 0; i + 1 < levels_.size(); ++i) {
    if (levels_[i].part == Part::rest) refuse(text_, "has a # that is not its last level");
  }
  for (const Part part : {Part::run, Part::node, Part::channel}) {
    const auto count = std::count_if(levels_.begin(), levels_.end(), [&](const Level& l) { return l.part == part; });
    if (count > 1) refuse(text_, "has the same place twice");
  }
}

std::string TopicPattern::filter() const {
  std::string filter;
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    if (i > 0) filter += '/';
    if (levels_[i].part == Part::text)
      filter += levels_[i].before;
    else
      filter += levels_[i].part == Part::rest ? '#' : '+';
  }
  return filter;
}

bool TopicPattern::names_run() const {
  return std::any_of(levels_.begin(), levels_.end(), [](const Level& level) { return level.part == Part::run; });
}

bool TopicPattern::match_level(const Level& level, std::string_view text, TopicPlace& place) {
  if (level.part == Part::text) return text == level.before;
  if (level.part == Part::any) return true;
  if (text.size() <= level.before.size() + level.after.size() || !text.starts_with(level.before) ||
      !text.ends_with(level.after))
    return false;
  text.remove_prefix(level.before.size());
  text.remove_suffix(level.after.size());
  (level.part == Part::run ? place.run : (level.part == Part::node ? place.node : place.channel)) = text;
  return true;
}

std::optional<TopicPlace> TopicPattern::match(std::string_view topic) const {
  TopicPlace place;
  std::size_t at = 0;
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    if (levels_[i].part == Part::rest) return place;
    if (at > topic.size()) return std::nullopt;
    const std::size_t end = std::min(topic.find('/', at), topic.size());
    if (!match_level(levels_[i], topic.substr(at, end - at), place)) return std::nullopt;
    at = end + 1;
  }
  if (at <= topic.size()) return std::nullopt;
  return place;
}

}  // namespace vigil
