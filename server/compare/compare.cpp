#include "server/compare/compare.hpp"

#include <algorithm>
#include <limits>
#include <set>

#include "engine/core/describe.hpp"
#include "engine/core/params.hpp"
#include "server/compare/metric_rows.hpp"
#include "server/compare/parameters.hpp"
#include "server/compare/series_rows.hpp"
#include "server/runs/glob.hpp"

namespace vigil {
namespace {

constexpr std::int64_t kMostSamples = 8'000'000;  // held at once, 64 MB
constexpr std::size_t kUsualSignals = 16;         // taken where none are named

void check_runs(const std::vector<ComparedRun>& runs) {
  if (runs.size() < 2 || runs.size() > kMostRuns) {
    throw InputError("/ids",
                     std::to_string(runs.size()) + (runs.size() == 1 ? " run is" : " runs are") +
                         " named; a comparison takes 2 to " + std::to_string(kMostRuns) + ".",
                     "2 to " + std::to_string(kMostRuns) + " runs");
  }
  std::set<std::string> seen;
  for (const ComparedRun& run : runs) {
    if (!seen.insert(run.id).second) throw InputError("/ids", "Run " + run.id + " is named twice.", "each run once");
  }
}

void align(std::vector<ComparedRun>& runs, bool by_attack) {
  if (!by_attack) return;
  for (ComparedRun& run : runs) {
    if (!run.attacked) {
      throw InputError("/align", "Run " + run.id + " has no attack to align by; align by tick instead.", "tick");
    }
    run.offset = *run.attacked;
  }
}

/// Every name of any run, in the order of the first that has it.
std::vector<ComparedSignal> all_signals(const std::vector<ComparedRun>& runs) {
  std::vector<ComparedSignal> all;
  std::unordered_map<std::string, std::size_t> places;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    for (const Signal& signal : runs[r].signals) {
      const auto [place, fresh] = places.emplace(signal.name, all.size());
      if (fresh) all.push_back({signal, std::vector<int>(runs.size(), -1)});
      all[place->second].ids[r] = signal.id;
    }
  }
  return all;
}

/// Those that fit a pattern and were not taken before; how many fit at all.
std::size_t take(std::string_view pattern, const std::vector<ComparedSignal>& all, std::vector<bool>& taken,
                 std::vector<ComparedSignal>& into) {
  std::size_t fits = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!glob_match(pattern, all[i].signal.name)) continue;
    ++fits;
    if (taken[i]) continue;
    taken[i] = true;
    into.push_back(all[i]);
  }
  return fits;
}

std::vector<ComparedSignal> usual_signals(const std::vector<ComparedSignal>& all) {
  std::vector<ComparedSignal> picked;
  for (const char* pattern : {"lane.*.error", "lane.*.estimate.*", "*"}) {
    std::vector<bool> taken(all.size(), false);
    if (take(pattern, all, taken, picked) > 0) break;
  }
  if (picked.size() > kUsualSignals) picked.resize(kUsualSignals);
  return picked;
}

[[noreturn]] void refuse_pattern(std::string_view pattern, const std::vector<ComparedSignal>& all) {
  std::vector<std::string> names;
  for (const ComparedSignal& one : all) names.push_back(one.signal.name);
  const std::string near = nearest(pattern, names);
  throw InputError("/signals",
                   "No signal of these runs is called, or fits, " + in_quotes(pattern) +
                       (near.empty() ? "." : "; did you mean " + in_quotes(near) + "?"),
                   "names and patterns with * and ?");
}

std::vector<ComparedSignal> pick(const std::vector<ComparedRun>& runs, std::string_view wanted) {
  const std::vector<ComparedSignal> all = all_signals(runs);
  if (wanted.empty()) return usual_signals(all);
  std::vector<ComparedSignal> picked;
  std::vector<bool> taken(all.size(), false);
  while (!wanted.empty()) {
    const std::size_t comma = wanted.find(',');
    const std::string_view pattern = wanted.substr(0, comma);
    wanted.remove_prefix(comma == std::string_view::npos ? wanted.size() : comma + 1);
    if (take(pattern, all, taken, picked) == 0) refuse_pattern(pattern, all);
  }
  if (picked.size() > kMostSignals) {
    throw InputError("/signals",
                     std::to_string(picked.size()) + " signals fit; a comparison takes at most " +
                         std::to_string(kMostSignals) + ": name fewer.",
                     "at most " + std::to_string(kMostSignals));
  }
  return picked;
}

/// What is asked for, cut to the ticks that any run has.
TickRange range_of(const std::vector<ComparedRun>& runs, const CompareOrder& order) {
  std::int64_t first = std::numeric_limits<std::int64_t>::max(), last = std::numeric_limits<std::int64_t>::min();
  for (const ComparedRun& run : runs) {
    if (run.no_samples()) continue;
    first = std::min(first, run.first - run.offset);
    last = std::max(last, run.last - run.offset);
  }
  if (first > last) return {0, -1};
  return {std::max(order.from.value_or(first), first), std::min(order.to.value_or(last), last)};
}

void check_size(const std::vector<ComparedRun>& runs, std::size_t signals, TickRange range) {
  std::int64_t ticks = 0;
  for (const ComparedRun& run : runs) {
    const std::int64_t from = std::max(run.first, range.from + run.offset);
    ticks += std::max<std::int64_t>(0, std::min(run.last, range.to + run.offset) - from + 1);
  }
  const auto most = kMostSamples / static_cast<std::int64_t>(std::max<std::size_t>(signals, 1));
  if (ticks <= most) return;
  throw InputError(
      "/from",
      std::to_string(signals) + " signals over " + std::to_string(ticks) +
          " ticks of all runs are too many samples to judge at once: ask for fewer signals or a shorter range.",
      "at most " + std::to_string(kMostSamples) + " samples in all");
}

Json run_json(const ComparedRun& run) {
  return {{"id", run.id},
          {"scenario", run.scenario},
          {"title", run.title},
          {"seed", run.seed ? Json(*run.seed) : Json()},
          {"state", run.state},
          {"parent", run.parent},
          {"dt", run.dt},
          {"first", run.no_samples() ? Json() : Json(run.first)},
          {"last", run.no_samples() ? Json() : Json(run.last)},
          {"attack", run.attacked ? Json(*run.attacked) : Json()},
          {"offset", run.offset}};
}

}  // namespace

Json compare_runs(std::vector<ComparedRun> runs, const CompareOrder& order) {
  check_runs(runs);
  align(runs, order.by_attack);
  const std::vector<ComparedSignal> signals = pick(runs, order.signals);
  const TickRange range = range_of(runs, order);
  check_size(runs, signals.size(), range);
  Json answer;
  answer["runs"] = Json::array();
  for (const ComparedRun& run : runs) answer["runs"].push_back(run_json(run));
  answer["range"] = range.from <= range.to ? Json{{"from", range.from}, {"to", range.to}} : Json();
  answer["parameters"] = differing_parameters(runs);
  answer["metrics"] = metric_rows(runs);
  answer["series"] = order.points > 0 ? series_rows(runs, signals, range, order.points) : Json::array();
  Judged judged = judge_runs(runs, signals, range, order.tolerance);
  answer["verdicts"] = std::move(judged.verdicts);
  answer["paired"] = std::move(judged.paired);
  for (Json& row : paired_metrics(runs)) answer["paired"].push_back(std::move(row));
  return answer;
}

}  // namespace vigil
