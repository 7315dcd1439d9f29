#include "server/compare/series_rows.hpp"

#include <algorithm>
#include <cmath>

#include "engine/metrics/paired.hpp"
#include "server/compare/metric_rows.hpp"

namespace vigil {
namespace {

constexpr std::size_t kMostStretches = 64;

Json numbers(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(finite_json(value));
  return list;
}

std::vector<int> ids_of(const std::vector<ComparedSignal>& signals, std::size_t run) {
  std::vector<int> ids;
  for (const ComparedSignal& signal : signals) {
    if (signal.ids[run] >= 0) ids.push_back(signal.ids[run]);
  }
  return ids;
}

/// Two runs' values of one signal at the ticks that both have.
struct Common {
  std::vector<std::int64_t> k;
  std::vector<double> base, other;
};

/// Where in each run's columns the common ticks lie.
struct Joint {
  std::vector<std::int64_t> k;
  std::vector<std::size_t> base, other;
};

Joint joint(const ComparedRun& a, const Columns& base, const ComparedRun& b, const Columns& other) {
  Joint result;
  for (std::size_t i = 0, j = 0; i < base.k.size() && j < other.k.size();) {
    const std::int64_t one = base.k[i] - a.offset, two = other.k[j] - b.offset;
    if (one == two) {
      result.k.push_back(one);
      result.base.push_back(i);
      result.other.push_back(j);
    }
    i += one <= two ? 1 : 0;
    j += two <= one ? 1 : 0;
  }
  return result;
}

std::vector<double> picked(const std::vector<double>& values, const std::vector<std::size_t>& rows) {
  std::vector<double> result;
  result.reserve(rows.size());
  for (const std::size_t row : rows) result.push_back(values[row]);
  return result;
}

/// At most kMostStretches: the ones that lie closest together are shown as one.
Json stretches_json(std::vector<ToleranceVerdict::Stretch> all) {
  for (std::int64_t apart = 2; all.size() > kMostStretches; apart *= 2) {
    std::vector<ToleranceVerdict::Stretch> fewer;
    for (const auto& stretch : all) {
      if (!fewer.empty() && stretch.first - fewer.back().last <= apart) {
        fewer.back().last = stretch.last;
      } else {
        fewer.push_back(stretch);
      }
    }
    all = std::move(fewer);
  }
  Json list = Json::array();
  for (const auto& stretch : all) list.push_back({stretch.first, stretch.last});
  return list;
}

Json verdict_json(const ToleranceVerdict& verdict) {
  Json json{{"ticks", verdict.ticks}, {"holds", verdict.ticks > 0 && verdict.holds()}};
  json["inside"] =
      verdict.ticks > 0 ? Json(static_cast<double>(verdict.inside) / static_cast<double>(verdict.ticks)) : Json();
  json["first"] = verdict.outside.empty() ? Json() : Json(verdict.first);
  json["worst"] = finite_json(verdict.worst);
  json["worst_at"] = std::isfinite(verdict.worst) ? Json(verdict.worst_at) : Json();
  json["outside"] = stretches_json(verdict.outside);
  return json;
}

Json window_json(const SampleWindow& window, std::size_t series, const ComparedRun& run) {
  Json item{{"run", run.id}, {"bucket", window.bucket}, {"k", Json::array()}};
  for (const std::int64_t k : window.k) item["k"].push_back(k - run.offset);
  if (window.raw) {
    item["v"] = numbers(window.series[series].v);
  } else {
    item["lo"] = numbers(window.series[series].lo);
    item["hi"] = numbers(window.series[series].hi);
  }
  return item;
}

}  // namespace

Json series_rows(const std::vector<ComparedRun>& runs, const std::vector<ComparedSignal>& signals, TickRange range,
                 int points) {
  Json rows = Json::array();
  for (const ComparedSignal& one : signals) {
    const Json described = to_json(one.signal);
    rows.push_back({{"signal", one.signal.name},
                    {"unit", one.signal.unit},
                    {"kind", described.at("kind")},
                    {"labels", described.value("labels", Json())},
                    {"runs", Json::array()}});
  }
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const ComparedRun& run = runs[r];
    const SampleWindow window = run.window(ids_of(signals, r), std::max<std::int64_t>(range.from + run.offset, 0),
                                           range.to + run.offset, points);
    std::size_t at = 0;
    for (std::size_t s = 0; s < signals.size(); ++s) {
      rows[s]["runs"].push_back(signals[s].ids[r] < 0 ? Json() : window_json(window, at++, run));
    }
  }
  return rows;
}

Judged judge_runs(const std::vector<ComparedRun>& runs, const std::vector<ComparedSignal>& signals, TickRange range,
                  const Tolerance& tolerance) {
  Judged judged;
  const auto read = [&](std::size_t r) {
    return runs[r].columns(ids_of(signals, r), range.from + runs[r].offset, range.to + runs[r].offset);
  };
  const Columns base = read(0);
  for (std::size_t r = 1; r < runs.size(); ++r) {
    const Columns other = read(r);
    const Joint rows = joint(runs[0], base, runs[r], other);
    std::size_t of_base = 0, of_other = 0;
    for (const ComparedSignal& signal : signals) {
      const std::size_t b = of_base, o = of_other;
      of_base += signal.ids[0] >= 0 ? 1 : 0;
      of_other += signal.ids[r] >= 0 ? 1 : 0;
      if (signal.ids[0] < 0 || signal.ids[r] < 0) continue;
      const std::vector<double> one = picked(base.values[b], rows.base), two = picked(other.values[o], rows.other);
      const bool scalar = signal.signal.kind == SignalKind::scalar;
      const Json head{{"signal", signal.signal.name}, {"run", runs[r].id}, {"against", runs[0].id}};
      Json verdict = head;
      verdict.update(verdict_json(scalar ? judge_tolerance(rows.k, one, two, tolerance)
                                         : judge_equal(rows.k, one, two, tolerance.shift)));
      judged.verdicts.push_back(std::move(verdict));
      if (!scalar) continue;
      Json paired = head;
      paired.update(paired_json(paired_in_time(one, two)));
      judged.paired.push_back(std::move(paired));
    }
  }
  return judged;
}

}  // namespace vigil
