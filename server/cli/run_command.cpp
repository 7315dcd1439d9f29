// `vigil run`: one run, as fast as it goes.
#include <chrono>
#include <fstream>
#include <iostream>
#include <memory>

#include "db/writer.hpp"
#include "engine/run/frame_csv.hpp"
#include "server/cli/commands.hpp"
#include "server/cli/files.hpp"
#include "server/cli/gain_finder.hpp"
#include "server/cli/progress.hpp"
#include "server/cli/report.hpp"
#include "server/cli/scenario_options.hpp"

namespace vigil {
namespace {

struct RunCommand {
  ScenarioOptions scenario;
  std::optional<std::int64_t> seed;
  std::string db, frames, json;
  GainFinder gains;
};

/// The frame file, written as the run goes.
class FrameFile {
 public:
  FrameFile(const std::string& file, const Catalogue& catalogue)
      : file_(file), stream_(file, std::ios::binary | std::ios::trunc) {
    if (!stream_) throw UserError(file_ + " cannot be written");
    text_ = csv_header(catalogue);
  }
  void add(const Frame& frame) {
    append_csv_row(text_, frame);
    if (text_.size() > (256u << 10)) flush();
  }
  void close() {
    flush();
    stream_.flush();
    if (!stream_) throw UserError(file_ + " cannot be written");
  }

 private:
  void flush() {
    stream_ << text_;
    text_.clear();
  }
  std::string file_, text_;
  std::ofstream stream_;
};

/// The run's row and samples in a log.
class Logged {
 public:
  Logged(const std::string& file, const RunOrder& order, const Run& run, const std::string& trace_file) : log_(file) {
    RunRecord record = make_record(order, run);
    if (order.trace && !trace_file.empty()) {
      record.trace = log_.put_trace(trace_file, read_text(trace_file), order.trace->rows(), order.trace->columns());
      record.input = {{"trace", std::to_string(*record.trace)}};
    }
    record.policy = LogPolicy::lossless;
    record.state = "running";
    id_ = log_.create_run(record).id;
    for (const Command& command : order.commands) log_.command(id_, command);
    log_.set_signals(id_, run.catalogue(), log_selection(record.document, run.catalogue()), LogPolicy::lossless,
                     run.dt());
    RunUpdate update;
    update.started = now();
    log_.post(id_, update);
  }
  void frame(const Frame& frame) { log_.frame(id_, frame); }
  void mark(const Mark& mark) { log_.mark(id_, mark); }
  void finish(const Run& run, const std::string& state) {
    RunUpdate update;
    update.state = state;
    update.ended = now();
    update.metrics = run.metrics();
    update.faults = run.faults();
    update.warnings = run.warnings();
    update.design = run.design();
    update.world = run.world();
    log_.finish(id_, update);
  }

 private:
  static WallTime now() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch())
        .count();
  }
  LogWriter log_;
  RunId id_ = 0;
};

class Outputs : public Sink {
 public:
  std::unique_ptr<FrameFile> file;
  std::unique_ptr<Logged> log;
  void frame(const Frame& frame) override {
    if (file) file->add(frame);
    if (log) log->frame(frame);
  }
  void mark(const Mark& mark) override {
    if (log) log->mark(mark);
  }
};

template <class Rows>
Json list_json(const Rows& rows) {
  Json list = Json::array();
  for (const auto& row : rows) list.push_back(to_json(row));
  return list;
}

Json result_json(const Run& run, const RunOrder& order, const std::string& state, double seconds) {
  Json result;
  result["scenario"] = run.scenario().id();
  result["seed"] = run.seed();
  result["version"] = std::string(version());
  result["steps"] = run.tick();
  result["state"] = state;
  result["metrics"] = list_json(run.metrics());
  result["design"] = run.design();
  drop_seconds(result["design"], order.designs);
  result["faults"] = list_json(run.faults());
  result["warnings"] = run.warnings();
  // Lanes share one run, so only the whole of it can honestly be timed.
  result["timing"]["run"] = {{"seconds", seconds}, {"ticks_per_second", static_cast<double>(run.tick() + 1) / seconds}};
  return result;
}

void print(const Run& run, const std::string& state) {
  std::cout << run.scenario().id() << ", seed " << run.seed() << ", " << run.tick() << " steps, " << state << "\n\n"
            << metric_table(run.metrics());
  const std::string faults = fault_lines(run.faults());
  if (!faults.empty()) std::cout << "\n" << faults;
  for (const std::string& warning : run.warnings()) std::cout << "\nwarning: " << warning << "\n";
}

double step_through(Run& run, Outputs& outputs, const std::optional<std::int64_t>& last) {
  Progress progress("tick", run.steps().value_or(last.value_or(-1)));
  const auto begin = std::chrono::steady_clock::now();
  while (!run.done() && (!last || run.tick() < *last)) {
    run.step(outputs);
    progress.at(run.tick());
  }
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

int carry_out(RunCommand& command) {
  RunOrder order = command.scenario.order();
  if (command.seed) order.seed = static_cast<std::uint64_t>(*command.seed);
  command.gains.require(order);
  Run run = make_run(order);
  require_end(order);
  Outputs outputs;
  if (!command.frames.empty()) outputs.file = std::make_unique<FrameFile>(command.frames, run.catalogue());
  if (!command.db.empty()) outputs.log = std::make_unique<Logged>(command.db, order, run, command.scenario.trace);
  const double seconds = step_through(run, outputs, order.last);
  const bool whole =
      !run.done() || order.end_state == "stopped" || !run.steps() || run.tick() >= *run.steps() || order.trace;
  const std::string state = whole ? "finished" : "failed";
  if (outputs.file) outputs.file->close();
  if (outputs.log) outputs.log->finish(run, state);
  if (command.json != "-") print(run, state);
  if (!command.json.empty()) {
    Json result = result_json(run, order, state, seconds);
    if (Json timing = command.gains.timing(); !timing.is_null()) result["timing"]["design"] = std::move(timing);
    write_text(command.json, result.dump(2) + "\n");
  }
  return any_stopped(run.faults()) ? kLaneStopped : kDone;
}

}  // namespace

void add_run(CLI::App& app, Action& action) {
  auto command = std::make_shared<RunCommand>();
  CLI::App* sub = app.add_subcommand("run", "one run, as fast as it goes");
  command->scenario.add_to(*sub);
  sub->add_option("--seed", command->seed, "1 without, or the bundle's")
      ->check(CLI::Range(std::int64_t{0}, static_cast<std::int64_t>(kLargestSeed)));
  sub->add_option("--db", command->db, "write the run into this log, too");
  sub->add_option("--frames", command->frames, "write every frame to this CSV file");
  sub->add_option("--json", command->json, "write the results as JSON to a file, or to standard output (-)");
  command->gains.add_to(*sub);
  sub->callback([command, &action] { action = [command] { return carry_out(*command); }; });
}

}  // namespace vigil
