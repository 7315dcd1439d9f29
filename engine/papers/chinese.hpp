/// What the items say, in Chinese: a catalogue as gettext has one, with the English text as its key.
#pragma once

#include <string>
#include <string_view>

namespace vigil::papers {

/// A claim, a statement of a paper's, a title, a label or a name: phrase by phrase between commas and colons, numbers
/// kept. Empty where a phrase is not in the catalogue.
std::string chinese(std::string_view english);

struct ItemWords {
  std::string_view rule, reason;
};

/// Rule and reason of an item. Null where there is no such item.
const ItemWords* chinese_words(std::string_view key);

}  // namespace vigil::papers
