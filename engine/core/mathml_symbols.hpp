/// Names of TeX that stand for one sign or one word.
#pragma once

#include <string>
#include <string_view>

namespace vigil::tex {

struct Symbol {
  const char* element;         ///< of MathML: mi, mo
  const char* text;            ///< UTF-8
  bool upright = false;        ///< a capital Greek letter
  bool under = false;          ///< what is below and above it stands there: a sum
  bool function = false;       ///< wants room before its argument
  const char* more = nullptr;  ///< attributes
};

/// Null where the name is not known.
const Symbol* find_symbol(std::string_view name);
/// A letter of \mathcal; empty where there is none.
std::string script_letter(char letter);

}  // namespace vigil::tex
