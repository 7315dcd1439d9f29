// `vigil synthesize`: gains and certificate of every lane that needs them, no run.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>

#include "server/cli/commands.hpp"
#include "server/cli/files.hpp"
#include "server/cli/gain_finder.hpp"
#include "server/cli/report.hpp"
#include "server/cli/scenario_options.hpp"
#include "server/synthesis/design_item.hpp"

namespace vigil {
namespace {

struct SynthesizeCommand {
  ScenarioOptions scenario;
  bool json = false;
  std::string sdpa;  ///< folder
  GainFinder gains;
};

/// One value a subsystem, with blanks between; of many the extremes.
std::string list_cell(const Json& values) {
  std::vector<double> numbers;
  for (const Json& value : values) numbers.push_back(value.is_number() ? value.get<double>() : std::nan(""));
  if (numbers.size() > 4) {
    const auto [low, high] = std::minmax_element(numbers.begin(), numbers.end());
    return six_digits(*low) + ".." + six_digits(*high);
  }
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "" : " ") + six_digits(number);
  return text;
}

std::string cell(const Json& record, const char* key) {
  const auto place = record.find(key);
  if (place == record.end()) return "-";
  if (place->is_string()) return place->get<std::string>();
  if (place->is_number()) return six_digits(place->get<double>());
  return place->is_array() ? list_cell(*place) : "-";
}

std::string table(const std::vector<DesignItem>& items) {
  const std::vector<const char*> columns{"solver",           "verdict",      "objective",     "gamma_d", "gamma_w",
                                         "lambda_max_sigma", "lambda_min_p", "max_real_pole", "norm_l",  "seconds"};
  std::vector<std::vector<std::string>> rows{{"lane", "certificate"}};
  rows.front().insert(rows.front().end(), columns.begin(), columns.end());
  for (const DesignItem& item : items) {
    std::vector<std::string> row{item.lane, item.state == DesignItem::State::done ? "holds" : "none"};
    // Figures of gains that are not there would be mistaken for some.
    const bool gains = item.record.is_object() && item.record.contains("L") && !item.record.at("L").is_null();
    for (const std::string_view column : columns) {
      const bool always = column == "solver" || column == "verdict" || column == "seconds";
      row.push_back(gains || always ? cell(item.record, column.data()) : "-");
    }
    rows.push_back(std::move(row));
  }
  std::string text = aligned(rows);
  for (const DesignItem& item : items) {
    if (item.state == DesignItem::State::refused) text += "\n" + item.lane + ": " + item.reason + "\n";
  }
  return text;
}

void write_problems(const std::string& folder, const std::vector<DesignTask>& tasks) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw UserError("--sdpa is " + folder + ", which cannot be made: " + error.message());
  for (const DesignTask& task : tasks) {
    write_text(std::filesystem::path(folder) / (task.lane + ".dat-s"),
               to_sdpa(task.problem(), "Vigil: gains of lane " + task.lane + ", problem " + task.key));
  }
}

int carry_out(SynthesizeCommand& command) {
  RunOrder order = command.scenario.order();
  const std::vector<DesignTask> tasks = design_tasks(order.scenario);
  if (!command.sdpa.empty()) write_problems(command.sdpa, tasks);
  command.gains.complete(order);
  std::vector<DesignItem> items;
  bool all_hold = true;
  for (const DesignTask& task : tasks) {
    items.push_back(
        settle({.lane = task.lane, .key = task.key, .limit = command.gains.limit()}, order.designs.at(task.lane)));
    all_hold = all_hold && items.back().state == DesignItem::State::done;
  }
  const std::string id = order.scenario.id();
  if (command.json) {
    Json result{{"scenario", id}, {"version", std::string(version())}, {"items", Json::array()}};
    for (const DesignItem& item : items) result["items"].push_back(to_json(item));
    std::cout << result.dump(2) << "\n";
  } else {
    std::cout << (items.empty() ? "No lane of " + id + " needs gains.\n" : table(items));
  }
  return all_hold ? kDone : kLaneStopped;
}

}  // namespace

void add_synthesize(CLI::App& app, Action& action) {
  auto command = std::make_shared<SynthesizeCommand>();
  CLI::App* sub = app.add_subcommand("synthesize", "gains and certificate of every lane that needs them, no run");
  command->scenario.add_document_to(*sub);
  sub->add_flag("--json", command->json, "as JSON");
  sub->add_option("--sdpa", command->sdpa, "write every problem into this folder, in SDPA's sparse format");
  command->gains.add_to(*sub);
  sub->callback([command, &action] { action = [command] { return carry_out(*command); }; });
}

}  // namespace vigil
