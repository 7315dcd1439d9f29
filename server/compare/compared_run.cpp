#include "server/compare/compared_run.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "server/runs/glob.hpp"

namespace vigil {
namespace {

constexpr std::int64_t kLastTick = std::numeric_limits<std::int64_t>::max() / 4;

std::vector<Signal> logged(const LogReader& reader, RunId run) {
  std::vector<Signal> signals = reader.signals(run);
  const std::vector<int> kept = reader.logged_signals(run);
  std::erase_if(signals,
                [&](const Signal& signal) { return !std::binary_search(kept.begin(), kept.end(), signal.id); });
  return signals;
}

std::optional<std::int64_t> first_attack(const LogReader& reader, RunId run) {
  MarkFilter filter;
  filter.types = {MarkType::attack};
  do {
    const MarkPage page = reader.marks(run, filter);
    for (const MarkPage::Item& item : page.items) {
      if (item.mark.edge == MarkEdge::begin) return item.mark.k;
    }
    filter.cursor = page.next.value_or("");
  } while (!filter.cursor.empty());
  return std::nullopt;
}

Columns read_columns(const LogReader& reader, RunId run, const std::vector<int>& signals, std::int64_t from,
                     std::int64_t to) {
  Columns columns;
  columns.values.resize(signals.size());
  reader.rows(run, signals, std::max<std::int64_t>(from, 0), to,
              [&](std::int64_t k, double, std::span<const double> v) {
                columns.k.push_back(k);
                for (std::size_t s = 0; s < v.size(); ++s) columns.values[s].push_back(v[s]);
                return true;
              });
  return columns;
}

std::optional<std::int64_t> first_state(const Trace& frames) {
  std::vector<int> states;
  for (const std::string& name : frames.columns()) {
    if (glob_match("link.*.state", name) || glob_match("sensor.*.state", name)) states.push_back(frames.find(name));
  }
  for (std::int64_t k = frames.first_tick(); k < frames.first_tick() + frames.rows(); ++k) {
    for (const int state : states) {
      if (frames.at(k, state) > 0) return k;
    }
  }
  return std::nullopt;
}

/// A frame file tells no kinds: what the contract names as a state or a flag is not measured in units.
SignalKind kind_of(const std::string& name) {
  for (const char* category : {"*.state", "*.choice", "*.rank", "*.source"}) {
    if (glob_match(category, name)) return SignalKind::category;
  }
  for (const char* flag : {"*.alarm", "*.overheard", "*.feasible28"}) {
    if (glob_match(flag, name)) return SignalKind::boolean;
  }
  return SignalKind::scalar;
}

}  // namespace

ComparedRun run_of_log(const LogReader& reader, const RunRow& row) {
  ComparedRun run;
  run.id = std::to_string(row.id);
  run.scenario = row.scenario;
  run.seed = row.seed;
  run.state = row.state;
  run.title = row.title;
  if (row.parent) run.parent = {{"run", std::to_string(row.parent->run)}, {"k", row.parent->k}};
  run.dt = row.dt;
  run.document = row.document;
  run.input = row.input;
  run.live = row.commands;
  run.metrics = row.metrics;
  run.signals = logged(reader, row.id);
  const SampleWindow all = reader.samples(row.id, {}, 0, kLastTick, 2);
  run.first = all.first;
  run.last = all.last;
  run.attacked = first_attack(reader, row.id);
  run.columns = [&reader, id = row.id](const std::vector<int>& signals, std::int64_t from, std::int64_t to) {
    return read_columns(reader, id, signals, from, to);
  };
  run.window = [&reader, id = row.id](const std::vector<int>& signals, std::int64_t from, std::int64_t to, int points) {
    return reader.samples(id, signals, from, to, points);
  };
  return run;
}

ComparedRun run_of_frames(const std::string& file, Trace frames) {
  ComparedRun run;
  run.id = file;
  run.state = "frames";
  run.dt = frames.dt();
  for (const std::string& name : frames.columns()) {
    Signal signal;
    signal.id = frames.find(name);
    signal.name = name;
    signal.kind = kind_of(name);
    run.signals.push_back(signal);
  }
  run.first = frames.first_tick();
  run.last = frames.first_tick() + frames.rows() - 1;
  run.attacked = first_state(frames);
  const auto held = std::make_shared<const Trace>(std::move(frames));
  run.columns = [held](const std::vector<int>& signals, std::int64_t from, std::int64_t to) {
    Columns columns;
    columns.values.resize(signals.size());
    const std::int64_t last = std::min(to, held->first_tick() + held->rows() - 1);
    for (std::int64_t k = std::max(from, held->first_tick()); k <= last; ++k) {
      columns.k.push_back(k);
      for (std::size_t s = 0; s < signals.size(); ++s) columns.values[s].push_back(held->at(k, signals[s]));
    }
    return columns;
  };
  return run;
}

}  // namespace vigil
