// `vigil campaign`: many runs, and a grid of parameters.
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>

#include "db/reader.hpp"
#include "server/campaigns/result.hpp"
#include "server/campaigns/work.hpp"
#include "server/cli/commands.hpp"
#include "server/cli/files.hpp"
#include "server/cli/gain_finder.hpp"
#include "server/cli/nats_options.hpp"
#include "server/cli/progress.hpp"
#include "server/cli/report.hpp"
#include "server/cli/scenario_options.hpp"
#include "server/crew/threads.hpp"
#include "server/runs/bundle.hpp"

namespace vigil {
namespace {

struct CampaignCommand {
  ScenarioOptions scenario;
  std::int64_t runs = 0;
  std::int64_t first_seed = 1;
  int threads = 0;
  std::vector<std::string> sweeps;
  std::string db, json;
  bool samples = false;
  std::optional<std::int64_t> resume;
  NatsFlags nats;
  GainFinder gains;
};

/// What the command asks for, and what it brings along.
struct Asked {
  CampaignRequest request;
  std::shared_ptr<const Trace> trace;
  Json designs = Json::object();
};

Asked read(const CampaignCommand& command) {
  if (command.scenario.scenario.empty()) throw UserError("SCENARIO is missing; expected one, or --resume ID");
  if (command.runs == 0) throw UserError("--runs is missing; expected how many runs each point has");
  const RunOrder order = command.scenario.order();
  if (!order.commands.empty())
    throw UserError("a bundle with live commands cannot be a campaign; its document alone can");
  require_end(order);
  Asked asked{{.scenario = order.scenario}, order.trace, order.designs};
  for (const std::string& text : command.sweeps) asked.request.sweep.push_back(parse_sweep(text));
  if (asked.request.cells() > kMostCells)
    throw UserError("--sweep asks for more than " + std::to_string(kMostCells) + " points");
  asked.request.runs = command.runs;
  asked.request.first_seed = static_cast<std::uint64_t>(command.first_seed);
  asked.request.threads = command.threads;
  asked.request.samples = command.samples;
  return asked;
}

/// The plan with every gain found; those of `known`, by cell, need no finding.
CampaignPlan complete(CampaignCommand& command, const Asked& asked, const std::vector<CampaignCellRow>& known) {
  CampaignPlan plan = make_plan(asked.request);
  plan.trace = asked.trace;
  for (std::size_t cell = 0; cell < plan.points.size(); ++cell) {
    CampaignPoint& point = plan.points[cell];
    RunOrder one;
    one.scenario = point.scenario;
    one.designs = cell < known.size() && known[cell].designs.is_object() ? known[cell].designs : asked.designs;
    command.gains.require(one);
    point.designs = std::move(one.designs);
  }
  RunOrder first;
  first.scenario = plan.points.front().scenario;
  first.seed = plan.first_seed;
  first.trace = plan.trace;
  first.designs = plan.points.front().designs;
  make_run(first);  // what no trial could be made of is bad input
  return plan;
}

struct Followed {
  std::vector<CellResult> cells;
  std::int64_t ticks = 0;  ///< of the trials that this process merged
  std::vector<CrewMember> crew;
};

/// Threads of this process, or the broker's workers. owner: as Broker::crew() has it.
std::unique_ptr<Crew> hire(Broker* broker, const std::string& owner) {
  return broker != nullptr ? broker->crew(owner) : std::make_unique<ThreadCrew>();
}

/// A campaign of a log, wherever it goes on from.
std::string owner_of(const std::string& db, std::int64_t id) {
  char host[256] = {};
  gethostname(host, sizeof host - 1);
  std::error_code error;
  return std::string(host) + ":" + std::filesystem::weakly_canonical(db, error).string() + "#" + std::to_string(id);
}

Followed in_memory(CampaignPlan plan, Broker* broker) {
  const auto crew = hire(broker, "");
  const std::atomic<bool> never{false};
  plan.trial = [&](std::int64_t index) { return plain_trial(plan, index, never); };
  Progress progress("run", plan.trials());
  Followed followed;
  CampaignCell cell;
  crew->run(plan, never, [&](std::int64_t index, const TrialResult& trial) {
    cell.add(trial);
    followed.ticks += trial.ticks;
    progress.at(index + 1);
    if ((index + 1) % plan.runs != 0) return;
    const std::int64_t place = index / plan.runs;
    followed.cells.push_back({place, plan.points[static_cast<std::size_t>(place)].sweep, cell.result()});
    cell = {};
  });
  followed.crew = crew->members();
  return followed;
}

bool open(const CampaignRow& row) {
  return row.state == "queued" || row.state == "paused" || row.state == "interrupted";
}

/// The campaign to go on with: the one that was named, or the newest open one of the same request.
std::optional<CampaignRow> unfinished(const LogReader& reader, const CampaignCommand& command, Asked& asked) {
  if (command.resume) {
    auto row = reader.campaign(*command.resume);
    if (!row) throw UserError("--resume is " + std::to_string(*command.resume) + "; the log has no such campaign");
    if (!open(*row)) throw UserError("campaign " + std::to_string(row->id) + " is " + row->state + ": it is over");
    asked.request = CampaignRequest::from_json(row->request);
    asked.request.threads = command.threads;
    if (asked.request.trace) {
      const auto text = reader.trace_csv(*asked.request.trace);
      if (!text) throw UserError("the trace of campaign " + std::to_string(row->id) + " was deleted from the log");
      asked.trace = std::make_shared<const Trace>(Trace::from_csv(*text));
    }
    return row;
  }
  for (CampaignRow& row : reader.campaigns()) {
    if (open(row) && CampaignRequest::from_json(row.request).identity() == asked.request.identity()) return row;
  }
  return std::nullopt;
}

Followed logged(CampaignCommand& command, Asked& asked, CampaignPlan& plan, Broker* broker) {
  LogWriter log(command.db);
  const LogReader reader(command.db);
  if (asked.trace) {
    // A bundle brings its trace along.
    const bool own = command.scenario.trace.empty();
    const std::string& file = own ? command.scenario.scenario : command.scenario.trace;
    const std::string text = own ? read_bundle(read_json(file)).trace_csv : read_text(file);
    asked.request.trace = log.put_trace(file, text, asked.trace->rows(), asked.trace->columns());
  }
  const auto row = unfinished(reader, command, asked);
  plan = complete(command, asked, row ? reader.campaign_cells(row->id) : std::vector<CampaignCellRow>());
  plan.trace_id = asked.request.trace;
  const std::int64_t id = row ? row->id : log.create_campaign(new_campaign(asked.request, plan)).id;
  if (row) {
    std::cerr << "vigil: campaign " << id << " goes on, " << row->done << " of " << row->trials
              << " trials are there already\n";
  }
  log.update_campaign(id, "running");
  const auto crew = hire(broker, owner_of(command.db, id));
  Progress progress("run", plan.trials());
  Followed followed;
  const std::atomic<bool> never{false};
  CampaignWork(log, reader, id, plan, asked.request.samples)
      .run(*crew, never, [&](std::int64_t done, const TrialResult& trial) {
        followed.ticks += trial.ticks;
        progress.at(done);
      });
  followed.crew = crew->members();
  log.update_campaign(id, "finished");
  for (std::size_t cell = 0; cell < plan.points.size(); ++cell) {
    const auto place = static_cast<std::int64_t>(cell);
    followed.cells.push_back({place, plan.points[cell].sweep, cell_result(reader, id, place, plan.runs)});
  }
  return followed;
}

Json result_json(const CampaignPlan& plan, const std::vector<CellResult>& cells) {
  const Scenario& scenario = plan.points.front().scenario;
  Json result;
  result["scenario"] = scenario.id();
  result["seed"] = plan.first_seed;
  result["version"] = std::string(version());
  result["steps"] = scenario.document().at("time").at("steps");
  result["runs"] = plan.runs;
  result["state"] = "finished";
  result["trials"] = trials_of(cells);
  result["metrics"] = rows_of(cells, "metrics");
  result["paired"] = rows_of(cells, "paired");
  result["detection"] = rows_of(cells, "detection");
  result["design"] = designs_of(cells);
  result["faults"] = rows_of(cells, "faults");
  result["warnings"] = warnings_of(cells);
  return result;
}

void print(const CampaignPlan& plan, const std::vector<CellResult>& cells) {
  std::cout << plan.points.front().scenario.id() << ", " << plan.runs << " runs from seed " << plan.first_seed << "\n";
  for (const CellResult& cell : cells) {
    std::cout << "\n";
    for (const auto& [path, value] : cell.sweep.items()) std::cout << path << " = " << value.dump() << "\n";
    std::cout << summary_table(summaries_of(cell.result.at("metrics")));
    const std::string lines = fault_lines(faults_of(cell.result.at("faults")));
    if (!lines.empty()) std::cout << "\n" << lines;
    const auto& failed = cell.result.at("trials").at("failed");
    if (failed != 0) std::cout << "\n" << failed << " trials have no result\n";
    for (const Json& warning : cell.result.at("warnings"))
      std::cout << "\nwarning: " << warning.get<std::string>() << "\n";
  }
}

int carry_out(CampaignCommand& command) {
  if (command.db.empty() && (command.samples || command.resume))
    throw UserError("--samples and --resume need --db FILE: the log that keeps the campaign");
  if (command.samples && command.nats.given())
    throw UserError("--samples keeps what this process makes; it does not go with --nats");
  Asked asked;
  if (!command.resume) asked = read(command);
  CampaignPlan plan;
  if (command.db.empty()) plan = complete(command, asked, {});
  const auto begin = std::chrono::steady_clock::now();
  const auto broker = command.nats.given() ? command.nats.connect() : nullptr;
  Followed followed;
  try {
    followed = command.db.empty() ? in_memory(plan, broker.get()) : logged(command, asked, plan, broker.get());
  } catch (const BrokerRefusal& refusal) {
    throw UserError(std::string("--nats: ") + refusal.what());
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  for (CellResult& cell : followed.cells)
    drop_seconds(cell.result["design"], plan.points[static_cast<std::size_t>(cell.cell)].designs);
  Json result = result_json(plan, followed.cells);
  const auto ticks = static_cast<double>(followed.ticks);
  result["timing"]["run"] = {{"seconds", seconds}, {"ticks_per_second", ticks / seconds}};
  for (const CrewMember& member : followed.crew) result["timing"]["workers"].push_back(to_json(member));
  if (Json timing = command.gains.timing(); !timing.is_null()) result["timing"]["design"] = std::move(timing);
  if (command.json != "-") print(plan, followed.cells);
  if (!command.json.empty()) write_text(command.json, result.dump(2) + "\n");
  const Json& trials = result.at("trials");
  return trials.at("stopped") != 0 || trials.at("failed") != 0 ? kLaneStopped : kDone;
}

}  // namespace

void add_campaign(CLI::App& app, Action& action) {
  auto command = std::make_shared<CampaignCommand>();
  CLI::App* sub = app.add_subcommand("campaign", "many runs: trial i has seed first + i");
  command->scenario.add_to(*sub);
  sub->get_option("SCENARIO")->required(false);
  sub->add_option("--runs", command->runs, "runs of each point")
      ->check(CLI::Range(std::int64_t{1}, std::int64_t{10'000'000}));
  sub->add_option("--first-seed", command->first_seed, "1 without")
      ->check(CLI::Range(std::int64_t{0}, static_cast<std::int64_t>(kLargestSeed) - 10'000'000));
  sub->add_option("--threads", command->threads, "all cores without; the results do not depend on it")
      ->check(CLI::Range(1, 1024))
      ->excludes(command->nats.add_to(*sub, "let workers make the trials: a broker's URL (vigil worker)"));
  sub->add_option("--sweep", command->sweeps, "PATH=V1,V2,…: a grid over every --sweep")
      ->take_all()
      ->allow_extra_args(false);
  sub->add_option("--db", command->db,
                  "keep the campaign in this log; one of the same request that did not end goes on");
  sub->add_option("--resume", command->resume, "the campaign of the log to go on with");
  sub->add_flag("--samples", command->samples, "keep every trial as a run with its samples, tagged campaign:ID");
  sub->add_option("--json", command->json, "write the results as JSON to a file, or to standard output (-)");
  command->gains.add_to(*sub);
  sub->callback([command, &action] { action = [command] { return carry_out(*command); }; });
}

}  // namespace vigil
