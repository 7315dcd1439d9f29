/// The mathematics of a method, protection or detector in words: what docs/methods says beyond the declared parameters.
/// One file `words.cpp` a family registers them by id; a test fails where a registered method has none.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/core/json.hpp"

namespace vigil {

/// A reading that stays selectable beside the one used.
enum class Reading {
  printed,  ///< what the source prints
  other     ///< what it may mean as well, where it is silent or open
};

/// One `Resolved:` entry of a specification that a method carries: where its source is wrong, silent or unreadable.
struct Correction {
  std::string text;            ///< what the source has and what is done instead, with the specification's section
  std::string parameter = {};  ///< the declared parameter that selects `reading`; empty: none does
  Json value = {};             ///< its value
  Reading reading = Reading::printed;
};

/// Markdown throughout; equations stand between backticks.
struct MethodWords {
  std::string id;
  std::string line;                ///< the index's line
  std::string model;               ///< what is assumed, with its equations and where they come from
  std::vector<std::string> steps;  ///< of one tick, in order
  std::string cost;                ///< orders in states n, sensors or nodes N, neighbours d, channels p of a sensor
  std::vector<Correction> corrected = {};
};

/// Words of one family, which names itself: "consensus (seed 000)".
struct WordsRegistration {
  WordsRegistration(const std::string& family, std::vector<MethodWords> words);
};

struct FamilyWords {
  std::string family;
  MethodWords words;
};

/// By id: the order of registration depends on the linker.
const std::vector<FamilyWords>& method_words();
/// Null where nobody has written any.
const FamilyWords* find_words(std::string_view id);

}  // namespace vigil
