/// The documentation of one method, protection or detector as data: what docs/methods has as text.
#pragma once

#include <optional>
#include <string_view>

#include "engine/core/json.hpp"
#include "engine/core/params.hpp"
#include "engine/methods/equation.hpp"

namespace vigil {

/// {"id","kind","title","family","source","line","model","equations","steps","where","parameters","cost","corrected"};
/// kind is "method", "protection" or "detector"; texts are Markdown with `code` alone. A parameter has "name",
/// "symbol", "default", "unit", "accepts", "live", "meaning"; a correction "text" and, where a parameter selects the
/// other reading, "parameter", "value", "printed" (whether that reading is what the source prints) and "usual". Null
/// where there is none.
Json method_page(std::string_view id);
/// {"items":[{"id","kind","title","family","line"}]}
Json method_index();
/// Empty where there is none.
std::optional<Words> method_title(std::string_view id);
/// {"id","number","corrected","says","tex","mathml"}
Json equation_json(const Equation& equation);

}  // namespace vigil
