// `vigil campaign`: many runs, and a grid of parameters.
#include <atomic>
#include <chrono>
#include <iostream>
#include <memory>
#include <thread>

#include "db/writer.hpp"
#include "server/cli/commands.hpp"
#include "server/cli/files.hpp"
#include "server/cli/gain_finder.hpp"
#include "server/cli/progress.hpp"
#include "server/cli/report.hpp"
#include "server/cli/scenario_options.hpp"
#include "server/runs/campaign_runner.hpp"

namespace vigil {
namespace {

constexpr std::size_t kMostPoints = 10'000;

struct CampaignCommand {
  ScenarioOptions scenario;
  std::int64_t runs = 0;
  std::int64_t first_seed = 1;
  int threads = 0;
  std::vector<std::string> sweeps;
  std::string db, json;
  GainFinder gains;
};

CampaignPlan make_plan(CampaignCommand& command) {
  const RunOrder order = command.scenario.order();
  if (!order.commands.empty())
    throw UserError("a bundle with live commands cannot be a campaign; its document alone can");
  require_end(order);
  std::vector<std::pair<std::string, std::vector<Json>>> sweeps;
  std::size_t points = 1;
  for (const std::string& text : command.sweeps) {
    sweeps.push_back(parse_sweep(text));
    points *= sweeps.back().second.size();
    if (points > kMostPoints) throw UserError("--sweep asks for more than " + std::to_string(kMostPoints) + " points");
  }
  CampaignPlan plan;
  plan.points = make_grid(order.scenario, sweeps);
  for (CampaignPoint& point : plan.points) {
    RunOrder one;
    one.scenario = point.scenario;
    one.designs = order.designs;
    command.gains.require(one);
    point.designs = std::move(one.designs);
  }
  plan.runs = command.runs;
  plan.first_seed = static_cast<std::uint64_t>(command.first_seed);
  plan.trace = order.trace;
  const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
  plan.threads = command.threads > 0 ? command.threads : static_cast<int>(cores);
  return plan;
}

/// The campaign's row in a log, and one row a trial.
class Logged {
 public:
  Logged(const std::string& file, const CampaignPlan& plan) : log_(file) {
    Json request{
        {"scenario", plan.points.front().scenario.document()}, {"runs", plan.runs}, {"first_seed", plan.first_seed}};
    for (const CampaignPoint& point : plan.points) request["points"].push_back(point.sweep);
    id_ = log_.create_campaign(request, plan.trials());
  }
  void add(std::int64_t index, const TrialResult& trial) {
    TrialRow row;
    row.index = index;
    row.seed = trial.seed;
    row.state = "finished";
    row.metrics = Json::array();
    for (const MetricValue& metric : trial.metrics) row.metrics.push_back(to_json(metric));
    log_.add_trial(id_, row);
  }
  void finish(const Json& result) { log_.update_campaign(id_, "finished", result); }

 private:
  LogWriter log_;
  std::int64_t id_ = 0;
};

Json result_json(const CampaignPlan& plan, const std::vector<CampaignOutcome>& outcomes) {
  const Scenario& scenario = plan.points.front().scenario;
  Json result;
  result["scenario"] = scenario.id();
  result["seed"] = plan.first_seed;
  result["version"] = std::string(version());
  result["steps"] = scenario.document().at("time").at("steps");
  result["runs"] = plan.runs;
  result["state"] = "finished";
  result["metrics"] = campaign_metrics_json(outcomes);
  result["design"] = campaign_design_json(outcomes);
  result["faults"] = campaign_faults_json(outcomes);
  result["warnings"] = campaign_warnings_json(outcomes);
  return result;
}

void print(const CampaignPlan& plan, const std::vector<CampaignOutcome>& outcomes) {
  std::cout << plan.points.front().scenario.id() << ", " << plan.runs << " runs from seed " << plan.first_seed << "\n";
  for (const CampaignOutcome& outcome : outcomes) {
    std::cout << "\n";
    for (const auto& [path, value] : outcome.sweep.items()) std::cout << path << " = " << value.dump() << "\n";
    std::cout << summary_table(outcome.metrics);
    std::vector<FaultCount> faults;
    for (const CampaignFault& fault : outcome.faults) faults.push_back(fault.fault);
    const std::string lines = fault_lines(faults);
    if (!lines.empty()) std::cout << "\n" << lines;
    for (const std::string& warning : outcome.warnings) std::cout << "\nwarning: " << warning << "\n";
  }
}

int carry_out(CampaignCommand& command) {
  const CampaignPlan plan = make_plan(command);
  std::unique_ptr<Logged> log;
  if (!command.db.empty()) log = std::make_unique<Logged>(command.db, plan);
  Progress progress("run", plan.trials());
  bool stopped = false;
  std::int64_t ticks = 0;
  const std::atomic<bool> never{false};
  const auto begin = std::chrono::steady_clock::now();
  auto outcomes = run_campaign(plan, never, [&](std::int64_t index, const TrialResult& trial) {
    if (log) log->add(index, trial);
    stopped = stopped || any_stopped(trial.faults);
    ticks += trial.ticks;
    progress.at(index + 1);
  });
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  for (std::size_t i = 0; i < outcomes.size(); ++i) drop_seconds(outcomes[i].design, plan.points[i].designs);
  Json result = result_json(plan, outcomes);
  if (log) log->finish(result);
  result["timing"]["run"] = {{"seconds", seconds}, {"ticks_per_second", static_cast<double>(ticks) / seconds}};
  if (Json timing = command.gains.timing(); !timing.is_null()) result["timing"]["design"] = std::move(timing);
  if (command.json != "-") print(plan, outcomes);
  if (!command.json.empty()) write_text(command.json, result.dump(2) + "\n");
  return stopped ? kLaneStopped : kDone;
}

}  // namespace

void add_campaign(CLI::App& app, Action& action) {
  auto command = std::make_shared<CampaignCommand>();
  CLI::App* sub = app.add_subcommand("campaign", "many runs: trial i has seed first + i");
  command->scenario.add_to(*sub);
  sub->add_option("--runs", command->runs, "runs of each point")
      ->required()
      ->check(CLI::Range(std::int64_t{1}, std::int64_t{10'000'000}));
  sub->add_option("--first-seed", command->first_seed, "1 without")
      ->check(CLI::Range(std::int64_t{0}, static_cast<std::int64_t>(kLargestSeed) - 10'000'000));
  sub->add_option("--threads", command->threads, "all cores without; the results do not depend on it")
      ->check(CLI::Range(1, 1024));
  sub->add_option("--sweep", command->sweeps, "PATH=V1,V2,…: a grid over every --sweep")
      ->take_all()
      ->allow_extra_args(false);
  sub->add_option("--db", command->db, "write the campaign into this log, too");
  sub->add_option("--json", command->json, "write the results as JSON to a file, or to standard output (-)");
  command->gains.add_to(*sub);
  sub->callback([command, &action] { action = [command] { return carry_out(*command); }; });
}

}  // namespace vigil
