// `vigil identify`: a linear model of a recorded table, as a scenario that runs.
#include <filesystem>
#include <iostream>
#include <memory>

#include "engine/core/describe.hpp"
#include "engine/identify/calibrate.hpp"
#include "engine/identify/identify.hpp"
#include "engine/scenario/scenario.hpp"
#include "server/cli/commands.hpp"
#include "server/cli/files.hpp"
#include "server/cli/identify_report.hpp"

namespace vigil {
namespace {

struct IdentifyCommand {
  std::string file, map, out, trace_of, trace_out;
  std::optional<int> lag;
  double false_alarms = 0.01;
  identify::Task task;
};

/// {"outputs":[…],"inputs":[…],"label":"…","dt":…}: what options say, for those who keep it in a file. Options go
/// before.
void read_map(const std::string& file, identify::Task& task) {
  const Json map = read_json(file);
  const auto refuse = [&](const std::string& key, const std::string& expected) {
    throw UserError(file + ": " + key + " is " + shown(map.contains(key) ? map[key] : Json(nullptr)) + "; expected " +
                    expected);
  };
  if (!map.is_object()) throw UserError(file + " is no object; expected {\"outputs\",\"inputs\",\"label\",\"dt\"}");
  for (const auto& [key, value] : map.items()) {
    const bool list = key == "outputs" || key == "inputs";
    if (!list && key != "label" && key != "dt")
      throw UserError(file + ": unknown key " + in_quotes(key) + "; expected outputs, inputs, label or dt");
    if (list) {
      std::vector<std::string>& columns = key == "outputs" ? task.outputs : task.inputs;
      if (!columns.empty()) continue;
      if (!value.is_array()) refuse(key, "a list of columns");
      for (const Json& column : value) {
        if (!column.is_string()) refuse(key, "a list of columns");
        columns.push_back(column.get<std::string>());
      }
    } else if (key == "label") {
      if (!value.is_string()) refuse(key, "the name of a column");
      if (task.label.empty()) task.label = value.get<std::string>();
    } else {
      if (!value.is_number() || !(value.get<double>() > 0)) refuse(key, "seconds above 0");
      task.dt = value.get<double>();
    }
  }
}

int carry_out(IdentifyCommand& command) {
  identify::Task& task = command.task;
  if (!command.map.empty()) read_map(command.map, task);
  if (task.outputs.empty()) throw UserError("--outputs is missing; expected columns, as --outputs L_T1,L_T2");
  task.settings.lag = command.lag;
  const std::filesystem::path out(command.out);
  task.source = std::filesystem::path(command.file).filename().string();
  std::string id;
  for (const char c : out.stem().string()) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-';
    const bool capital = c >= 'A' && c <= 'Z';
    id += plain ? c : capital ? static_cast<char>(c - 'A' + 'a') : '-';
  }
  id.erase(0, std::min(id.find_first_not_of('-'), id.size()));
  if (!id.empty()) task.id = id.substr(0, 64);
  const std::string text = read_text(command.file);
  const identify::Identified found = identify::identify(text, task);
  const std::string trace = identify::table_to_trace(text, found.mapping);
  const Scenario scenario = identify::calibrated(Scenario::from_json(identify::scenario_of(found, task)),
                                                 std::make_shared<Trace>(Trace::from_csv(trace)), command.false_alarms);
  write_text(command.out, scenario.document().dump(1) + "\n");
  if (!command.trace_out.empty()) {
    const bool same = command.trace_of.empty();
    write_text(command.trace_out, same ? trace : identify::table_to_trace(read_text(command.trace_of), found.mapping));
  }
  std::cout << identify_report(found, task);
  return kDone;
}

}  // namespace

void add_identify(CLI::App& app, Action& action) {
  auto command = std::make_shared<IdentifyCommand>();
  identify::Task& task = command->task;
  CLI::App* sub = app.add_subcommand("identify", "a linear model of a recorded table, as a scenario that runs");
  sub->add_option("FILE", command->file, "the table: a header of names, one row a tick")->required();
  sub->add_option("--outputs", task.outputs, "columns that are measured; * stands for any text")->delimiter(',');
  sub->add_option("--inputs", task.inputs, "columns that are known and drive them")->delimiter(',');
  sub->add_option("--label", task.label, "column above zero where a row is attacked");
  sub->add_option("--map", command->map, "the same from a file: {\"outputs\",\"inputs\",\"label\",\"dt\"}");
  sub->add_option("--dt", task.dt, "seconds between rows")->check(CLI::Range(1e-9, 1e9));
  sub->add_option("--max-order", task.settings.max_order, "most lags that are tried")->check(CLI::Range(1, 12));
  sub->add_option("--holdout", task.settings.holdout, "share of the rows, the last, that is held back")
      ->check(CLI::Range(0.01, 0.9));
  sub->add_option("--input-lag", command->lag, "0: a row's inputs acted up to it, 1: from it on; none: both are tried")
      ->check(CLI::Range(0, 1));
  sub->add_option("--reading-noise", task.reading_share, "share of the residuals laid to the readings")
      ->check(CLI::Range(1e-6, 0.45));
  sub->add_option("--window", task.window, "innovations in the statistic of the detectors fixed and dynamic")
      ->check(CLI::Range(1, 1000));
  sub->add_option("--false-alarms", command->false_alarms, "share of clean rows that learned thresholds let through")
      ->check(CLI::Range(1e-6, 0.5));
  sub->add_option("--out", command->out, "the scenario")->required();
  CLI::Option* trace = sub->add_option("--trace-out", command->trace_out, "the rows as a trace");
  sub->add_option("--trace-of", command->trace_of, "another table with the same columns, which the trace is made of")
      ->needs(trace);
  sub->callback([command, &action] { action = [command] { return carry_out(*command); }; });
}

}  // namespace vigil
