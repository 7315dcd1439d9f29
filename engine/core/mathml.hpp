/// Equations that are written as TeX, as presentation MathML: browsers draw it without a script.
#pragma once

#include <string>
#include <string_view>

namespace vigil {

/// A block `<math>`, without a namespace, for HTML. What it knows of TeX: letters, numbers, operators, `^ _ { }` and
/// primes; `\frac \sqrt \hat \bar \tilde \dot \text \mathrm \operatorname \mathcal`; Greek letters, the symbols and
/// functions of mathml_symbols.hpp; `\sum`, `\min` and their like with what stands below and above; `\left … \right`;
/// the environments `bmatrix`, `cases` and `aligned`. Throws std::invalid_argument saying what else was met, and where.
std::string mathml(std::string_view tex);

}  // namespace vigil
