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
  std::string made = {};  ///< how it came about, where items of one report differ in that
};

/// Titles, tables, verdicts and reasons, figures as inline SVG.
std::string report_html(const std::vector<Measured>& measured, std::int64_t runs, std::uint64_t first_seed);
/// The same of items that were not made in one go; `made` says what they have in common.
std::string report_html(const std::vector<Measured>& measured, const std::string& made);
/// The same in a few columns for a terminal.
std::string report_text(const std::vector<Measured>& measured);

}  // namespace vigil::papers
