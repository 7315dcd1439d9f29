// `vigil papers`: every figure and table of the sources, run again and judged.
#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>
#include <thread>

#include "engine/core/describe.hpp"
#include "server/cli/commands.hpp"
#include "server/cli/files.hpp"
#include "server/cli/gain_finder.hpp"
#include "server/cli/progress.hpp"
#include "server/papers/report.hpp"
#include "server/papers/threads.hpp"

namespace vigil {
namespace {

struct PapersCommand {
  std::vector<std::string> only;
  std::int64_t runs = 200;
  std::int64_t first_seed = 1;
  int threads = 0;
  std::string json, html;
  GainFinder gains;
};

std::vector<const papers::Item*> chosen(const std::vector<std::string>& only) {
  std::vector<const papers::Item*> list;
  std::vector<std::string> keys;
  for (const papers::Item& item : papers::items()) {
    keys.push_back(item.key);
    if (only.empty() || std::find(only.begin(), only.end(), item.key) != only.end()) list.push_back(&item);
  }
  for (const std::string& key : only) {
    if (std::find(keys.begin(), keys.end(), key) == keys.end())
      throw UserError("there is no item " + in_quotes(key) + "; expected one of " + listed(keys));
  }
  return list;
}

LaboratoryOptions options_of(PapersCommand& command, Progress& progress) {
  LaboratoryOptions options;
  options.runs = command.runs;
  options.first_seed = static_cast<std::uint64_t>(command.first_seed);
  const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
  options.threads = command.threads > 0 ? command.threads : static_cast<int>(cores);
  options.gains = [&command](const DesignTask& task) { return command.gains.find(task); };
  options.progress = [&progress](std::int64_t done) { progress.at(done); };
  return options;
}

int carry_out(PapersCommand& command) {
  const auto list = chosen(command.only);
  std::vector<papers::Measured> measured;
  const auto begin = std::chrono::steady_clock::now();
  {
    Progress progress("run", -1);
    ThreadedLaboratory laboratory(options_of(command, progress));
    for (const papers::Item* item : list) measured.push_back({item, item->measure(laboratory)});
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (command.json != "-") {
    std::cout << papers::report_text(measured) << list.size() << " items, " << command.runs << " runs, "
              << static_cast<std::int64_t>(seconds + 0.5) << " s\n";
  }
  if (!command.json.empty()) {
    Json items = Json::array();
    for (const papers::Measured& one : measured) {
      items.push_back(to_json(*one.item, one.findings));
      items.back().update(papers::basis_json(*one.item));
    }
    write_text(command.json, items.dump(2) + "\n");
  }
  if (!command.html.empty()) {
    const auto seed = static_cast<std::uint64_t>(command.first_seed);
    write_text(command.html, papers::report_html(measured, command.runs, seed));
  }
  return kDone;
}

}  // namespace

void add_papers(CLI::App& app, Action& action) {
  auto command = std::make_shared<PapersCommand>();
  CLI::App* sub = app.add_subcommand("papers", "every figure and table of the five papers, run again and judged");
  sub->add_option("--only", command->only, "KEY of a figure or table, such as 003/fig5; all without")
      ->take_all()
      ->allow_extra_args(false);
  sub->add_option("--runs", command->runs, "runs of each campaign, 200 without")
      ->check(CLI::Range(std::int64_t{2}, std::int64_t{100'000}));
  sub->add_option("--seed", command->first_seed, "the first seed, 1 without")
      ->check(CLI::Range(std::int64_t{0}, static_cast<std::int64_t>(kLargestSeed) - 100'000));
  sub->add_option("--threads", command->threads, "all cores without; the results do not depend on it")
      ->check(CLI::Range(1, 1024));
  sub->add_option("--json", command->json, "write every item as JSON to a file, or to standard output (-)");
  sub->add_option("--html", command->html, "write a report of everything as one page to a file");
  command->gains.add_to(*sub);
  sub->callback([command, &action] { action = [command] { return carry_out(*command); }; });
}

}  // namespace vigil
