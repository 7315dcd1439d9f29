/// A panel of a figure as inline SVG.
#pragma once

#include <string>

#include "engine/papers/item.hpp"

namespace vigil::papers {

/// Axes with ticks and labels, series in the colours of the report's style sheet (classes c0 … c8), a legend of at most
/// nine names. Points that are not finite, and on a logarithmic axis those that are not positive, are gaps.
std::string svg_of(const Panel& panel);
/// Text as HTML may hold it.
std::string escaped(const std::string& text);

}  // namespace vigil::papers
