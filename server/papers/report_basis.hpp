/// What the items of the report stand on: their runs, equations and methods.
#pragma once

#include <string>
#include <vector>

#include "engine/papers/item.hpp"

namespace vigil::papers {

/// Text as HTML, what stands between backticks as code.
std::string marked(const std::string& text);
/// Runs, equations as MathML, links to the methods below.
std::string basis_html(const Item& item);
/// The documentation of the methods that these items stand on.
std::string methods_html(const std::vector<const Item*>& items);

}  // namespace vigil::papers
