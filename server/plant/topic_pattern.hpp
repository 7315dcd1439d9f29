/// Topics of a plant that feed runs, as one writes them on a command line.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/ingest/plant_reader.hpp"

namespace vigil {

/// Levels between '/', each a text, "+" (any level), "{run}", "{node}" or "{channel}", alone or within a text as in
/// "tank-{node}"; the last may be "#" (any further levels).
class TopicPattern {
 public:
  /// Throws InputError (no pointer) with one sentence.
  explicit TopicPattern(const std::string& text);

  const std::string& text() const { return text_; }
  /// What a broker is asked for: the text with '+' for each level that has a place.
  std::string filter() const;
  /// True where a topic says which run it is for.
  bool names_run() const;
  /// What the topic says; empty where it is not one of these.
  std::optional<TopicPlace> match(std::string_view topic) const;

 private:
  enum class Part { text, any, rest, run, node, channel };
  struct Level {
    Part part = Part::text;
    std::string before, after;  ///< a place's surroundings; before: all of a text
  };
  static Level read_level(const std::string& text, const std::string& whole);
  static bool match_level(const Level& level, std::string_view text, TopicPlace& place);
  void check() const;

  std::string text_;
  std::vector<Level> levels_;
};

}  // namespace vigil
