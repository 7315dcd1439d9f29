/// SDPA's sparse format.
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "engine/core/input_error.hpp"
#include "engine/linalg/sdp.hpp"

namespace vigil {
namespace {

/// Numbers of the format are set apart by blanks or by any of ,(){}; comments precede the first of them.
class Reader {
 public:
  explicit Reader(std::string_view text) : rest_(text) {
    while (!rest_.empty() && (rest_[0] == '"' || rest_[0] == '*' || rest_[0] == '\n')) next_line();
  }
  void next_line() {
    const auto end = rest_.find('\n');
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    ++line_;
  }
  bool at_end() {
    skip();
    return rest_.empty();
  }
  int integer() {
    const double value = number();
    if (value != std::floor(value) || std::abs(value) > 1e9) fail("a whole number was expected");
    return static_cast<int>(value);
  }
  double number() {
    skip();
    if (!rest_.empty() && rest_[0] == '+') rest_.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    if (error != std::errc() || !std::isfinite(value)) fail("a number was expected");
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    return value;
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError("", fmt::format("line {} of the SDPA text: {}", line_, what));
  }

 private:
  void skip() {
    while (!rest_.empty() && std::string_view(" \t\r\n,(){}").find(rest_[0]) != std::string_view::npos) {
      if (rest_[0] == '\n') ++line_;
      rest_.remove_prefix(1);
    }
  }
  std::string_view rest_;
  int line_ = 1;
};

int count(Reader& reader, const char* what) {
  const int value = reader.integer();
  if (value < 0 || value > 100000) reader.fail(fmt::format("no such number of {}: {}", what, value));
  return value;
}

}  // namespace

std::string to_sdpa(const SdpProblem& problem, const std::string& title) {
  std::string text;
  if (!title.empty()) text += fmt::format("\"{}\n", title);
  text += fmt::format("{}\n{}\n{}\n", problem.variables(), problem.blocks.size(), fmt::join(problem.blocks, " "));
  text += fmt::format("{}\n", fmt::join(problem.cost, " "));
  for (const SdpEntry& entry : problem.entries) {
    text +=
        fmt::format("{} {} {} {} {}\n", entry.matrix, entry.block + 1, entry.row + 1, entry.column + 1, entry.value);
  }
  return text;
}

SdpProblem read_sdpa(std::string_view text) {
  Reader reader(text);
  SdpProblem problem;
  problem.cost.resize(static_cast<std::size_t>(count(reader, "variables")));
  reader.next_line();  // what follows the number on its line is a comment
  problem.blocks.resize(static_cast<std::size_t>(count(reader, "blocks")));
  reader.next_line();
  for (int& order : problem.blocks) order = count(reader, "rows");
  for (double& cost : problem.cost) cost = reader.number();
  while (!reader.at_end()) {
    SdpEntry entry;
    entry.matrix = reader.integer();
    for (int* index : {&entry.block, &entry.row, &entry.column}) *index = reader.integer() - 1;
    entry.value = reader.number();
    problem.entries.push_back(entry);
  }
  try {
    canonicalise(problem);
  } catch (const std::invalid_argument& error) {
    reader.fail(error.what());
  }
  return problem;
}

}  // namespace vigil
