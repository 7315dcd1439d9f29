/// Equations as the code has them, written by hand beside the methods: shown in docs/methods, with the papers' items
/// and in their report. One file `equations.cpp` a family registers them; tests see to it that each can be drawn.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/core/params.hpp"

namespace vigil {

/// Where the source has it: "(27)", "Table 2"; empty where it numbers nothing.
struct EquationNumber {
  EquationNumber(const char* where, bool differs = false) : text(where), corrected(differs) {}

  std::string text;
  bool corrected = false;  ///< the code has something else than the source prints
};

struct Equation {
  std::string id;  ///< family and name: "consensus/27"
  EquationNumber number;
  Words says;                             ///< what it gives, and what was corrected
  std::string tex;                        ///< of the subset of engine/core/mathml.hpp
  std::vector<std::string> methods = {};  ///< whose pages show it; none: it belongs to a plant, an attack or a metric
};

struct EquationsRegistration {
  explicit EquationsRegistration(std::vector<Equation> equations);
};

/// By family, and within one as they were written.
const std::vector<Equation>& equations();
/// Null where there is none.
const Equation* find_equation(std::string_view id);
std::vector<const Equation*> equations_of(std::string_view method);

}  // namespace vigil
