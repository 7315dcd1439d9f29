#include "engine/identify/identify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "engine/core/describe.hpp"
#include "engine/core/input_error.hpp"
#include "engine/identify/table.hpp"
#include "engine/linalg/small.hpp"

namespace vigil::identify {
namespace {

/// A column's name as the id of a node: letters, digits and '_', at most 16, none twice.
std::string node_id(const std::string& column, const std::vector<std::string>& taken) {
  std::string id;
  for (const char c : column) {
    const auto byte = static_cast<unsigned char>(c);
    if (id.size() < 16) id += byte < 0x80U && std::isalnum(byte) != 0 ? c : '_';
  }
  static const std::vector<std::string> reserved{"fused", "optimal", "sent", "eve", "truth", "input", "sensor"};
  const auto used = [](const std::vector<std::string>& words, const std::string& word) {
    return std::find(words.begin(), words.end(), word) != words.end();
  };
  if (!id.empty() && !used(taken, id) && !used(reserved, id)) return id;
  return "y" + std::to_string(taken.size() + 1);
}

bool moves(const Eigen::VectorXd& column) {
  double least = INFINITY, most = -INFINITY;
  for (const double value : column) {
    if (!std::isfinite(value)) continue;
    least = std::min(least, value);
    most = std::max(most, value);
  }
  return most > least;
}

void check_columns(const Identified& found, const Task& task) {
  for (std::size_t i = 0; i < found.inputs.size(); ++i) {
    const std::string& name = found.inputs[i];
    if (std::find(found.outputs.begin(), found.outputs.end(), name) != found.outputs.end() || name == task.label)
      throw InputError("/inputs", in_quotes(name) + " is an output or the label as well; expected each column once");
  }
  if (found.inputs.size() >= kMaxSmall)
    throw InputError(
        "/inputs",
        fmt::format("{} inputs move ({}); expected at most {}, since the constant is one more and a plant has "
                    "at most {}",
                    found.inputs.size(), listed(found.inputs), kMaxSmall - 1, kMaxSmall));
}

Mapping mapping_of(const Identified& found, const Task& task) {
  Mapping mapping;
  mapping.dt = task.dt;
  for (std::size_t i = 0; i < found.outputs.size(); ++i)
    mapping.columns.emplace_back("sensor." + found.nodes[i] + ".y1", found.outputs[i]);
  for (std::size_t i = 0; i < found.inputs.size(); ++i)
    mapping.columns.emplace_back(fmt::format("input.u{}", i + 1), found.inputs[i]);
  mapping.constants.emplace_back(fmt::format("input.u{}", found.inputs.size() + 1), 1.0);
  mapping.input_lag = found.choice.model.lag;
  mapping.label = task.label;
  if (!task.label.empty()) mapping.labelled = found.nodes;
  return mapping;
}

}  // namespace

Identified identify(std::string_view text, const Task& task) {
  const std::vector<std::string> header = header_of(text);
  Identified found;
  found.outputs = chosen_columns(header, task.outputs);
  const std::vector<std::string> inputs = chosen_columns(header, task.inputs);
  if (!task.label.empty()) chosen_columns(header, {task.label});
  Records records{read_table(text, found.outputs).values, {}, found.outputs};
  found.rows = records.outputs.rows();
  records.inputs.resize(found.rows, 0);
  if (!inputs.empty()) {
    const Table table = read_table(text, inputs);
    std::vector<Eigen::Index> kept;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      const auto c = static_cast<Eigen::Index>(i);
      const bool kept_one = moves(table.values.col(c));
      (kept_one ? found.inputs : found.flat).push_back(inputs[i]);
      if (kept_one) kept.push_back(c);
    }
    records.inputs = table.values(Eigen::all, kept);
  }
  check_columns(found, task);
  for (const std::string& column : found.outputs) found.nodes.push_back(node_id(column, found.nodes));
  Settings settings = task.settings;
  settings.most_states = std::min(settings.most_states, kMaxSmall);
  found.choice = choose(records, settings);
  found.space = state_space(found.choice.model, records, found.choice.residuals, task.reading_share);
  found.mapping = mapping_of(found, task);
  return found;
}

}  // namespace vigil::identify
