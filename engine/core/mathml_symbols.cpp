#include "engine/core/mathml_symbols.hpp"

#include <array>
#include <map>

namespace vigil::tex {
namespace {

constexpr const char* kFlat = " stretchy=\"false\"";

Symbol letter(const char* text) { return {"mi", text}; }
Symbol capital(const char* text) { return {"mi", text, true}; }
Symbol sign(const char* text) { return {"mo", text}; }
Symbol fence(const char* text) { return {"mo", text, false, false, false, kFlat}; }
Symbol large(const char* text) { return {"mo", text, false, true}; }
Symbol word(const char* text) { return {"mi", text, false, false, true}; }
Symbol word_above(const char* text) { return {"mi", text, false, true, true}; }

std::map<std::string_view, Symbol> letters() {
  return {{"alpha", letter("α")},    {"beta", letter("β")},     {"gamma", letter("γ")},  {"delta", letter("δ")},
          {"epsilon", letter("ϵ")},  {"zeta", letter("ζ")},     {"eta", letter("η")},    {"theta", letter("θ")},
          {"iota", letter("ι")},     {"kappa", letter("κ")},    {"lambda", letter("λ")}, {"mu", letter("μ")},
          {"nu", letter("ν")},       {"xi", letter("ξ")},       {"pi", letter("π")},     {"rho", letter("ρ")},
          {"sigma", letter("σ")},    {"tau", letter("τ")},      {"phi", letter("ϕ")},    {"varphi", letter("φ")},
          {"chi", letter("χ")},      {"psi", letter("ψ")},      {"omega", letter("ω")},  {"varepsilon", letter("ε")},
          {"varsigma", letter("ς")}, {"vartheta", letter("ϑ")}, {"Gamma", capital("Γ")}, {"Delta", capital("Δ")},
          {"Theta", capital("Θ")},   {"Lambda", capital("Λ")},  {"Xi", capital("Ξ")},    {"Pi", capital("Π")},
          {"Sigma", capital("Σ")},   {"Phi", capital("Φ")},     {"Psi", capital("Ψ")},   {"Omega", capital("Ω")},
          {"infty", letter("∞")},    {"partial", letter("∂")},  {"top", letter("⊤")},    {"dagger", letter("†")},
          {"ell", letter("ℓ")}};
}

std::map<std::string_view, Symbol> signs() {
  return {{"cdot", sign("⋅")},        {"times", sign("×")},
          {"le", sign("≤")},          {"ge", sign("≥")},
          {"ne", sign("≠")},          {"in", sign("∈")},
          {"notin", sign("∉")},       {"to", sign("→")},
          {"mid", sign("∣")},         {"approx", sign("≈")},
          {"sim", sign("∼")},         {"pm", sign("±")},
          {"oplus", sign("⊕")},       {"Leftrightarrow", sign("⇔")},
          {"ldots", sign("…")},       {"cdots", sign("⋯")},
          {"succ", sign("≻")},        {"prec", sign("≺")},
          {"leftarrow", sign("←")},   {"gg", sign("≫")},
          {"ll", sign("≪")},          {"subset", sign("⊂")},
          {"cup", sign("∪")},         {"circ", sign("∘")},
          {"ast", sign("∗")},         {"colon", sign(":")},
          {"lVert", fence("‖")},      {"rVert", fence("‖")},
          {"lvert", fence("|")},      {"rvert", fence("|")},
          {"lfloor", fence("⌊")},     {"rfloor", fence("⌋")},
          {"langle", fence("⟨")},     {"rangle", fence("⟩")},
          {"{", fence("{")},          {"}", fence("}")},
          {"|", fence("‖")},          {"sum", large("∑")},
          {"prod", large("∏")},       {"int", sign("∫")},
          {"max", word_above("max")}, {"min", word_above("min")},
          {"sup", word_above("sup")}, {"arg", word("arg")},
          {"ln", word("ln")},         {"log", word("log")},
          {"exp", word("exp")},       {"sin", word("sin")},
          {"cos", word("cos")},       {"det", word("det")}};
}

}  // namespace

const Symbol* find_symbol(std::string_view name) {
  static const std::map<std::string_view, Symbol> all = [] {
    auto map = letters();
    map.merge(signs());
    return map;
  }();
  const auto place = all.find(name);
  return place == all.end() ? nullptr : &place->second;
}

std::string script_letter(char letter) {
  static constexpr std::array<const char*, 26> kLetters{"𝒜", "ℬ", "𝒞", "𝒟", "ℰ", "ℱ", "𝒢", "ℋ", "ℐ",
                                                        "𝒥", "𝒦", "ℒ", "ℳ", "𝒩", "𝒪", "𝒫", "𝒬", "ℛ",
                                                        "𝒮", "𝒯", "𝒰", "𝒱", "𝒲", "𝒳", "𝒴", "𝒵"};
  return letter >= 'A' && letter <= 'Z' ? kLetters[static_cast<std::size_t>(letter - 'A')] : "";
}

}  // namespace vigil::tex
