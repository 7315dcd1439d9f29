/// Bad input: what the user can mend. Thrown while a document, a trace or a command is read, never in a tick.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace vigil {

/// One thing wrong with an input.
struct Problem {
  std::string pointer;  ///< JSON pointer (RFC 6901) of the field, "" for the whole
  std::string detail;   ///< one sentence: the value and what was expected
  std::string allowed;  ///< range, choices or nearest valid key; may be empty
};

/// Carries every problem found; what() is one sentence that names the first field, its value and what was expected.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<Problem> problems);
  InputError(std::string pointer, std::string detail, std::string allowed = {});
  const std::vector<Problem>& problems() const { return problems_; }

 private:
  std::vector<Problem> problems_;
};

}  // namespace vigil
