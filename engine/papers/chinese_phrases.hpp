/// The catalogue behind chinese.hpp.
#pragma once

#include <span>
#include <string_view>
#include <utility>

#include "engine/papers/chinese.hpp"

namespace vigil::papers {

/// English with `#` for a number, and Chinese with {1}, {2}, … for the numbers in their order.
using Phrase = std::pair<std::string_view, std::string_view>;

std::span<const Phrase> claim_phrases();
/// What the papers say, and the words of the figures.
std::span<const Phrase> figure_phrases();

struct KeyedWords {
  std::string_view key;
  ItemWords words;
};

std::span<const KeyedWords> plant_items_words();  ///< seeds 000 to 002
std::span<const KeyedWords> replay_items_words();
std::span<const KeyedWords> privacy_items_words();

}  // namespace vigil::papers
