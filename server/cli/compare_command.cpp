// `vigil compare`: runs of a log, or frame files, side by side.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>

#include "db/reader.hpp"
#include "server/cli/commands.hpp"
#include "server/cli/files.hpp"
#include "server/cli/report.hpp"
#include "server/compare/compare.hpp"

namespace vigil {
namespace {

using Rows = std::vector<std::vector<std::string>>;

struct CompareCommand {
  std::vector<std::string> runs;
  std::string db = "vigil.db", align = "tick", json;
  CompareOrder order;
};

bool is_id(const std::string& text) {
  return !text.empty() && text.size() < 19 && text.find_first_not_of("0123456789") == std::string::npos;
}

ComparedRun logged(const LogReader& reader, const std::string& id, const std::string& db) {
  const auto row = reader.run(std::stoll(id));
  if (!row) throw UserError("RUN is " + id + "; there is no such run in " + db);
  return run_of_log(reader, *row);
}

ComparedRun framed(const std::string& file) {
  const std::string text = read_text(file);
  try {
    return run_of_frames(file, Trace::from_csv(text));
  } catch (const InputError& error) {
    throw UserError("RUN is " + file + ", which is neither an id nor a frame file: " + error.what());
  }
}

std::string cell_text(const Json& value) {
  if (value.is_null()) return "-";
  if (value.is_number_float()) return six_digits(value.get<double>());
  if (value.is_string()) return value.get<std::string>();
  return value.dump();
}

std::string number_of(const Json& value) { return value.is_number() ? six_digits(value.get<double>()) : "-"; }

std::string metric_name(const Json& metric) {
  std::string name = metric.at("lane").get<std::string>() + " " + metric.at("name").get<std::string>();
  if (!metric.at("variant").is_null()) name += " " + metric.at("variant").get<std::string>();
  return name;
}

void print_runs(const Json& runs) {
  Rows rows{{"run", "scenario", "seed", "state", "ticks", "first attack", "offset"}};
  for (const Json& run : runs) {
    const std::string ticks = run.at("first").is_null() ? "-" : cell_text(run["first"]) + ".." + cell_text(run["last"]);
    rows.push_back({cell_text(run["id"]), cell_text(run["scenario"]), cell_text(run["seed"]), cell_text(run["state"]),
                    ticks, cell_text(run["attack"]), cell_text(run["offset"])});
  }
  std::cout << aligned(rows);
}

/// One column a run, named by its place: ids of frame files may be long.
std::vector<std::string> header(const std::string& first, const Json& runs) {
  std::vector<std::string> cells{first};
  for (const Json& run : runs) {
    const std::string id = run.at("id").get<std::string>();
    cells.push_back(is_id(id) ? "run " + id : std::filesystem::path(id).filename().string());
  }
  return cells;
}

void print_parameters(const Json& answer) {
  if (answer.at("parameters").empty()) return;
  Rows rows{header("parameters that differ", answer.at("runs"))};
  for (const Json& row : answer.at("parameters")) {
    rows.push_back({row.at("path").get<std::string>()});
    for (const Json& value : row.at("values")) {
      std::string text = cell_text(value);
      if (text.size() > 40) text = text.substr(0, 37) + "...";
      rows.back().push_back(text);
    }
  }
  std::cout << "\n" << aligned(rows);
}

void print_metrics(const Json& answer) {
  Rows rows{header("metric (network)", answer.at("runs"))};
  for (const Json& row : answer.at("metrics")) {
    if (!row.at("node").is_null()) continue;
    rows.push_back({metric_name(row)});
    for (const Json& value : row.at("values")) rows.back().push_back(cell_text(value));
  }
  if (rows.size() > 1) std::cout << "\n" << aligned(rows);
}

void print_verdicts(const Json& answer) {
  Rows rows{{"signal", "run", "verdict", "inside", "first outside", "worst", "at", "mean difference", "95 % interval"}};
  for (const Json& verdict : answer.at("verdicts")) {
    std::string mean = "-", interval = "-";
    for (const Json& paired : answer.at("paired")) {
      if (paired.value("signal", Json()) != verdict.at("signal") || paired.value("run", Json()) != verdict.at("run"))
        continue;
      mean = number_of(paired.at("mean"));
      if (!paired.at("ci").is_null()) interval = number_of(paired["ci"][0]) + " to " + number_of(paired["ci"][1]);
    }
    const bool judged = verdict.at("ticks").get<std::int64_t>() > 0;
    const std::string word = !judged ? "no common tick" : verdict.at("holds").get<bool>() ? "within" : "outside";
    const std::string share = judged ? six_digits(100 * verdict.at("inside").get<double>()) + " %" : "-";
    rows.push_back({cell_text(verdict["signal"]), cell_text(verdict["run"]), word, share, cell_text(verdict["first"]),
                    number_of(verdict["worst"]), cell_text(verdict["worst_at"]), mean, interval});
  }
  if (rows.size() > 1) std::cout << "\n" << aligned(rows);
}

void print_pairs(const Json& answer) {
  Rows rows{{"metric, paired by seed", "against", "mean difference", "se", "95 % interval", "p", "n"}};
  for (const Json& row : answer.at("paired")) {
    if (!row.contains("metric") || !row["metric"].at("node").is_null()) continue;
    const std::string interval =
        row.at("ci").is_null() ? "-" : number_of(row["ci"][0]) + " to " + number_of(row["ci"][1]);
    rows.push_back({metric_name(row["metric"]), cell_text(row.at("against")), number_of(row.at("mean")),
                    number_of(row.at("se")), interval, number_of(row.at("p")), cell_text(row.at("n"))});
  }
  if (rows.size() > 1) std::cout << "\n" << aligned(rows);
}

int carry_out(CompareCommand& command) {
  command.order.by_attack = command.align == "attack";
  const Tolerance& tolerance = command.order.tolerance;
  if (!std::isfinite(tolerance.abs) || !std::isfinite(tolerance.rel))
    throw UserError("--abs and --rel must be finite numbers >= 0");
  std::unique_ptr<LogReader> reader;
  std::vector<ComparedRun> runs;
  for (const std::string& name : command.runs) {
    if (is_id(name) && !reader) reader = std::make_unique<LogReader>(command.db);
    runs.push_back(is_id(name) ? logged(*reader, name, command.db) : framed(name));
  }
  const Json answer = compare_runs(std::move(runs), command.order);
  if (command.json != "-") {
    print_runs(answer.at("runs"));
    print_parameters(answer);
    print_metrics(answer);
    print_verdicts(answer);
    print_pairs(answer);
  }
  if (!command.json.empty()) write_text(command.json, answer.dump(2) + "\n");
  return kDone;
}

}  // namespace

void add_compare(CLI::App& app, Action& action) {
  auto command = std::make_shared<CompareCommand>();
  CLI::App* sub =
      app.add_subcommand("compare", "runs side by side: parameters, metrics, tolerances, paired differences");
  sub->add_option("RUN", command->runs, "2 to 10 ids of runs in the log, or frame files; the first is the base")
      ->required();
  sub->add_option("--db", command->db, "the log that ids are of")->capture_default_str();
  sub->add_option("--signals", command->order.signals,
                  "names and patterns, comma-separated; the lanes' errors without");
  sub->add_option("--align", command->align, "tick, or attack: tick 0 is where each run's first attack begins")
      ->check(CLI::IsMember({"tick", "attack"}));
  sub->add_option("--abs", command->order.tolerance.abs, "absolute tolerance")->check(CLI::NonNegativeNumber);
  sub->add_option("--rel", command->order.tolerance.rel, "tolerance relative to the base; the wider counts")
      ->check(CLI::NonNegativeNumber);
  sub->add_option("--shift", command->order.tolerance.shift, "ticks that a value may come early or late")
      ->check(CLI::Range(std::int64_t{0}, std::int64_t{100'000}));
  sub->add_option("--from", command->order.from, "first tick, after alignment");
  sub->add_option("--to", command->order.to, "last tick, included");
  sub->add_option("--json", command->json, "write the comparison as JSON to a file, or to standard output (-)");
  sub->callback([command, &action] { action = [command] { return carry_out(*command); }; });
}

}  // namespace vigil
