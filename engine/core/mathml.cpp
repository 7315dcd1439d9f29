#include "engine/core/mathml.hpp"

#include <cctype>
#include <stdexcept>

#include "engine/core/mathml_symbols.hpp"

namespace vigil {
namespace {

using tex::Symbol;

std::string element(const std::string& name, const std::string& inside, const std::string& attributes = "") {
  return "<" + name + attributes + ">" + inside + "</" + name + ">";
}

std::string escaped(char c) {
  switch (c) {
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '-':
      return "−";
    default:
      return {c};
  }
}

/// A browser drops an ordinary space at a text's end.
std::string with_hard_spaces(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == ' ' ? "\u00a0" : std::string{c};
  return result;
}

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }
bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

/// What a piece of TeX became, and where what is below and above it stands.
struct Atom {
  std::string xml;
  bool under = false;
  bool function = false;
};

class Parser {
 public:
  explicit Parser(std::string_view tex) : tex_(tex) {}

  std::string whole() {
    const std::string inside = row();
    if (at_ < tex_.size()) fail("is not expected");
    return inside;
  }

 private:
  [[noreturn]] void fail(const std::string& why) const {
    throw std::invalid_argument("\"" + std::string(tex_.substr(at_, 12)) + "\" " + why + " at " + std::to_string(at_) +
                                " of " + std::string(tex_));
  }
  void skip_space() {
    while (at_ < tex_.size() && tex_[at_] == ' ') ++at_;
  }
  bool meets(std::string_view what) {
    skip_space();
    return tex_.substr(at_).starts_with(what);
  }
  bool take(std::string_view what) {
    if (!meets(what)) return false;
    at_ += what.size();
    return true;
  }
  void need(std::string_view what) {
    if (!take(what)) fail("stands where \"" + std::string(what) + "\" is expected");
  }
  bool ends() {
    skip_space();
    return at_ >= tex_.size() || meets("}") || meets("&") || meets("\\\\") || meets("\\right") || meets("\\end");
  }

  std::string row() {
    std::string inside;
    while (!ends()) {
      const bool after_letter = !inside.empty() && !inside.ends_with("</mo>") && !inside.ends_with("/>");
      inside += scripted(after_letter);
    }
    return element("mrow", inside);
  }

  /// An atom with what is written below, above and behind it.
  std::string scripted(bool after_letter) {
    const Atom base = atom();
    std::string below, above;
    for (;;) {
      if (take("_")) {
        below = argument();
      } else if (take("^")) {
        above = argument();
      } else if (take("'")) {
        above = "<mo>′</mo>";
      } else {
        break;
      }
    }
    const std::string room = "<mspace width=\"0.17em\"/>";
    std::string xml = (base.function && after_letter ? room : "") + with_scripts(base, below, above);
    if (base.function && !meets("(") && !meets("\\left") && !meets("[")) xml += room;
    return xml;
  }

  static std::string with_scripts(const Atom& base, const std::string& below, const std::string& above) {
    if (below.empty() && above.empty()) return base.xml;
    if (above.empty()) return element(base.under ? "munder" : "msub", base.xml + below);
    if (below.empty()) return element(base.under ? "mover" : "msup", base.xml + above);
    return element(base.under ? "munderover" : "msubsup", base.xml + below + above);
  }

  /// A group, or one atom.
  std::string argument() {
    if (!take("{")) return atom().xml;
    std::string inside = row();
    need("}");
    return inside;
  }

  std::string plain_group() {
    need("{");
    const auto end = tex_.find('}', at_);
    if (end == std::string_view::npos) fail("is not closed");
    std::string text(tex_.substr(at_, end - at_));
    at_ = end + 1;
    return text;
  }

  Atom atom() {
    skip_space();
    if (at_ >= tex_.size()) fail("ends too early");
    const char c = tex_[at_];
    if (c == '\\') return command();
    if (c == '{') return {argument()};
    if (is_letter(c)) {
      ++at_;
      return {element("mi", {c})};
    }
    if (is_digit(c)) return {number()};
    if (std::string_view("+-=<>()[]|,;:/.!*").find(c) == std::string_view::npos) fail("is not known");
    ++at_;
    const bool flat = std::string_view("()[]|/").find(c) != std::string_view::npos;
    return {element("mo", escaped(c), flat ? " stretchy=\"false\"" : "")};
  }

  bool starts_fraction() const { return tex_[at_] == '.' && at_ + 1 < tex_.size() && is_digit(tex_[at_ + 1]); }

  std::string number() {
    const auto begin = at_;
    while (at_ < tex_.size() && (is_digit(tex_[at_]) || starts_fraction())) ++at_;
    return element("mn", std::string(tex_.substr(begin, at_ - begin)));
  }

  std::string name() {
    need("\\");
    const auto begin = at_;
    while (at_ < tex_.size() && is_letter(tex_[at_])) ++at_;
    if (at_ == begin && at_ < tex_.size()) ++at_;
    return std::string(tex_.substr(begin, at_ - begin));
  }

  Atom command() {
    const auto begin = at_;
    const std::string what = name();
    if (const Symbol* symbol = tex::find_symbol(what)) return of(*symbol);
    if (what == "frac") {
      const std::string above = argument();
      return {element("mfrac", above + argument())};
    }
    if (what == "sqrt") return {element("msqrt", argument())};
    if (what == "begin") return {environment()};
    if (what == "left") return {fenced()};
    if (what == "text") return {element("mtext", with_hard_spaces(plain_group()))};
    if (what == "mathrm") return {element("mi", plain_group(), " mathvariant=\"normal\"")};
    if (what == "operatorname") return {element("mi", plain_group(), " mathvariant=\"normal\""), false, true};
    if (what == "mathcal") return {script()};
    if (const char* accent = accent_of(what))
      return {element("mover", argument() + element("mo", accent), " accent=\"true\"")};
    if (const char* width = space_of(what)) return {std::string("<mspace width=\"") + width + "\"/>"};
    at_ = begin;
    fail("is not known");
  }

  static Atom of(const Symbol& symbol) {
    const std::string attributes = symbol.upright ? " mathvariant=\"normal\"" : symbol.more ? symbol.more : "";
    return {element(symbol.element, symbol.text, attributes), symbol.under, symbol.function};
  }

  static const char* accent_of(const std::string& name) {
    if (name == "hat") return "^";
    if (name == "bar") return "‾";
    if (name == "tilde") return "~";
    return name == "dot" ? "˙" : nullptr;
  }

  static const char* space_of(const std::string& name) {
    if (name == ",") return "0.17em";
    if (name == ";") return "0.28em";
    if (name == "quad") return "1em";
    return name == "qquad" ? "2em" : nullptr;
  }

  std::string script() {
    const std::string letters = plain_group();
    const std::string text = letters.size() == 1 ? tex::script_letter(letters[0]) : "";
    if (text.empty()) fail("follows a letter that has no script form");
    return element("mi", text);
  }

  std::string delimiter(const char* form) {
    skip_space();
    if (take(".")) return "";
    const std::string attributes = std::string(" stretchy=\"true\" form=\"") + form + "\"";
    if (meets("\\")) {
      const Symbol* symbol = tex::find_symbol(name());
      if (symbol == nullptr) fail("follows no delimiter");
      return element("mo", symbol->text, attributes);
    }
    if (at_ >= tex_.size()) fail("ends without a delimiter");
    return element("mo", escaped(tex_[at_++]), attributes);
  }

  std::string fenced() {
    const std::string open = delimiter("prefix"), inside = row();
    need("\\right");
    return element("mrow", open + inside + delimiter("postfix"));
  }

  std::string environment() {
    const std::string kind = plain_group();
    const bool aligned = kind == "aligned", cases = kind == "cases";
    if (!aligned && !cases && kind != "bmatrix") fail("follows an environment that is not known");
    std::string rows, cells;
    for (;;) {
      cells += element("mtd", row());
      if (take("&")) continue;
      rows += element("mtr", cells);
      cells.clear();
      if (!take("\\\\")) break;
    }
    need("\\end");
    if (plain_group() != kind) fail("follows the end of another environment");
    const std::string table = element("mtable", rows,
                                      aligned ? " displaystyle=\"true\" class=\"tex-aligned\""
                                      : cases ? " class=\"tex-cases\""
                                              : "");
    if (aligned) return table;
    const std::string open = element("mo", cases ? "{" : "[", " stretchy=\"true\" form=\"prefix\"");
    return element("mrow", open + table + (cases ? "" : "<mo stretchy=\"true\" form=\"postfix\">]</mo>"));
  }

  std::string_view tex_;
  std::size_t at_ = 0;
};

}  // namespace

std::string mathml(std::string_view tex) { return element("math", Parser(tex).whole(), " display=\"block\""); }

}  // namespace vigil
