#include "engine/core/input_error.hpp"

#include <utility>

namespace vigil {
namespace {

std::string sentence(const std::vector<Problem>& problems) {
  if (problems.empty()) return "the input is not valid";
  const Problem& first = problems.front();
  std::string text = first.pointer.empty() ? first.detail : first.pointer + ": " + first.detail;
  if (problems.size() > 1) {
    text +=
        " (and " + std::to_string(problems.size() - 1) + (problems.size() == 2 ? " more problem)" : " more problems)");
  }
  return text;
}

}  // namespace

InputError::InputError(std::vector<Problem> problems)
    : std::runtime_error(sentence(problems)), problems_(std::move(problems)) {}

InputError::InputError(std::string pointer, std::string detail, std::string allowed)
    : InputError(std::vector<Problem>{{std::move(pointer), std::move(detail), std::move(allowed)}}) {}

}  // namespace vigil
