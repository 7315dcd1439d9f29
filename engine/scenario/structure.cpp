#include "engine/scenario/structure.hpp"

#include <cmath>

#include "engine/core/describe.hpp"

namespace vigil {
namespace {

constexpr std::size_t kMostProblems = 100;

class Structure {
 public:
  explicit Structure(std::vector<Problem>& problems)
      : problems_(problems), most_problems_(problems.size() + kMostProblems) {}

  void visit(const Json& value, const std::string& pointer, std::size_t depth) {
    if (problems_.size() >= most_problems_ || values_ > kMostValues) return;
    if (++values_ > kMostValues)
      return add(pointer, "the document has more than 200000 values", "at most 200000 values");
    if (depth > kDeepest) return add(pointer, "the document is nested more than 32 deep", "at most 32 levels");
    if (value.is_string()) return text(value.get_ref<const std::string&>(), pointer);
    if (value.is_number()) return number(value.get<double>(), pointer);
    if (value.is_binary()) return add(pointer, "a binary value is no JSON", "JSON");
    if (value.is_array()) return array(value, pointer, depth);
    if (value.is_object()) return object(value, pointer, depth);
  }

 private:
  void add(const std::string& pointer, const std::string& detail, const std::string& allowed) {
    problems_.push_back({pointer, detail, allowed});
  }

  void text(const std::string& value, const std::string& pointer) {
    if (value.size() > kLongestText) {
      add(pointer, "the text has " + std::to_string(value.size()) + " bytes; expected at most 4096",
          "at most 4096 bytes");
    } else if (!is_utf8(value)) {
      add(pointer, "the text " + in_quotes(value) + " is not UTF-8", "UTF-8");
    }
  }

  void number(double value, const std::string& pointer) {
    if (!std::isfinite(value)) add(pointer, number_text(value) + " is not a finite number", "a finite number");
  }

  void array(const Json& value, const std::string& pointer, std::size_t depth) {
    for (std::size_t n = 0; n < value.size(); ++n) visit(value[n], child(pointer, n), depth + 1);
  }

  void object(const Json& value, const std::string& pointer, std::size_t depth) {
    for (const auto& [key, member] : value.items()) {
      text(key, child(pointer, key));
      visit(member, child(pointer, key), depth + 1);
    }
  }

  std::vector<Problem>& problems_;
  std::size_t most_problems_;
  std::size_t values_ = 0;
};

}  // namespace

void check_structure(const Json& value, const std::string& pointer, std::vector<Problem>& problems) {
  Structure(problems).visit(value, pointer, 1);
}

}  // namespace vigil
