#include "engine/methods/equation.hpp"

#include <algorithm>
#include <utility>

namespace vigil {
namespace {

std::vector<Equation>& list() {
  static std::vector<Equation> all;
  return all;
}

std::string_view family_of(const Equation& equation) {
  return std::string_view(equation.id).substr(0, equation.id.find('/'));
}

}  // namespace

EquationsRegistration::EquationsRegistration(std::vector<Equation> equations) {
  for (Equation& one : equations) list().push_back(std::move(one));
  std::stable_sort(list().begin(), list().end(),
                   [](const Equation& a, const Equation& b) { return family_of(a) < family_of(b); });
}

const std::vector<Equation>& equations() { return list(); }

const Equation* find_equation(std::string_view id) {
  const auto place = std::find_if(list().begin(), list().end(), [&](const Equation& one) { return one.id == id; });
  return place == list().end() ? nullptr : &*place;
}

std::vector<const Equation*> equations_of(std::string_view method) {
  std::vector<const Equation*> found;
  for (const Equation& one : list()) {
    if (std::find(one.methods.begin(), one.methods.end(), method) != one.methods.end()) found.push_back(&one);
  }
  return found;
}

}  // namespace vigil
