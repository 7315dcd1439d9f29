/// The report of all items as one static page that needs nothing else.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/papers/item.hpp"

namespace vigil::papers {

struct Measured {
  const Item* item = nullptr;
  Findings findings;
};

/// Titles, tables, verdicts and reasons, figures as inline SVG.
std::string report_html(const std::vector<Measured>& measured, std::int64_t runs, std::uint64_t first_seed);
/// The same in a few columns for a terminal.
std::string report_text(const std::vector<Measured>& measured);

}  // namespace vigil::papers
