/// Seed 001, figures 3 to 6: tracks, errors, and whose estimate a station takes.
#include <algorithm>
#include <cmath>

#include "engine/papers/curves.hpp"
#include "engine/papers/sparse.hpp"

namespace vigil::papers {
namespace {

constexpr int kNodes = 5;
const char* const kSays = "a picture";

std::string signal(const std::string& lane, int node, const std::string& what) {
  return "lane." + lane + "." + std::to_string(node) + "." + what;
}

std::shared_ptr<const Records> records_of(Laboratory& laboratory, const std::string& lane) {
  std::vector<std::string> names{"truth.px", "truth.py", "truth.vx"};
  for (int n = 1; n <= kNodes; ++n) {
    for (const char* what : {"px", "py", "vx"}) names.push_back(signal(lane, n, std::string("estimate.") + what));
  }
  return laboratory.samples(preset("sparse", {lane}), names, sparse_runs(laboratory, lane));
}

/// Root mean square of a component's error at a station over some ticks of all runs.
Estimate error_of(const Records& records, const std::string& lane, int node, const std::string& what, std::size_t from,
                  std::size_t to) {
  return root_of(of_runs(records, [&](const Record& record) {
    double sum = 0;
    for (std::size_t k = from; k <= to; ++k)
      sum += std::pow(record.at(signal(lane, node, "estimate." + what), k) - record.at("truth." + what, k), 2);
    return sum / static_cast<double>(to - from + 1);
  }));
}

Estimate worst_of(const Records& records, const std::string& lane, const std::string& what, std::size_t from,
                  std::size_t to) {
  Estimate worst{-1};
  for (int n = 1; n <= kNodes; ++n) {
    const Estimate one = error_of(records, lane, n, what, from, to);
    if (one.value > worst.value) worst = one;
  }
  return worst;
}

void error_panels(Findings& found, Laboratory& laboratory, const std::string& what, const char* unit) {
  for (const std::string& lane : kAlgorithms) {
    const auto records = records_of(laboratory, lane);
    const Record& record = records->front();
    Panel panel{lane + ", one run", {"t (s)"}, {"error of " + what + " (" + unit + ")"}, {}};
    for (int n = 1; n <= kNodes; ++n)
      panel.series.push_back(series("station " + std::to_string(n), record.time,
                                    difference(record, signal(lane, n, "estimate." + what), "truth." + what), "line",
                                    1));
    found.panels.push_back(std::move(panel));
  }
}

Findings tracks(Laboratory& laboratory) {
  Findings found;
  const auto of = [&](const char* lane) { return records_of(laboratory, lane); };
  const auto claim = [&](const char* what, Estimate ours, double low, double high) {
    found.claim(Reading::corrected, std::string("RMS of the error of px, m: ") + what, kSays, ours, low, high);
  };
  const auto a1 = of("omp_game");
  found.runs = static_cast<std::int64_t>(a1->size());
  claim("A1, worst station, until 9 s", worst_of(*a1, "omp_game", "px", 1, 179), 0, 0.05);
  claim("A2, station 4, until 6 s", error_of(*of("l1"), "l1", 4, "px", 6, 119), 3, 60);
  claim("A4, station 4, until 6 s", error_of(*of("etpg"), "etpg", 4, "px", 6, 119), 1.5, 60);
  claim("A3, worst station", worst_of(*of("dkf"), "dkf", "px", 1, 200), 3, 60);
  claim("A5, worst station, until 6 s", worst_of(*of("sdlms"), "sdlms", "px", 1, 119), 0, 1);
  for (const std::string& lane : kAlgorithms) {
    const auto records = records_of(laboratory, lane);
    const Record& record = records->front();
    Panel panel{
        lane + ", one run", {"x (m)"}, {"y (m)"}, {series("truth", record.of("truth.px"), record.of("truth.py"))}};
    for (int n = 1; n <= kNodes; ++n)
      panel.series.push_back(series("station " + std::to_string(n), record.of(signal(lane, n, "estimate.px")),
                                    record.of(signal(lane, n, "estimate.py")), "dashed", 1));
    found.panels.push_back(std::move(panel));
  }
  return found;
}

Findings positions(Laboratory& laboratory) {
  Findings found;
  const auto claim = [&](const char* lane, const char* what, int node, std::size_t from, std::size_t to, double low,
                         double high) {
    const auto records = records_of(laboratory, lane);
    found.runs = std::max(found.runs, static_cast<std::int64_t>(records->size()));
    const Estimate ours =
        node == 0 ? worst_of(*records, lane, "px", from, to) : error_of(*records, lane, node, "px", from, to);
    found.claim(Reading::corrected, std::string("RMS of the error of px, m: ") + what, kSays, ours, low, high);
  };
  claim("omp_game", "A1, worst station, until 9 s", 0, 1, 179, 0, 0.05);
  claim("omp_game", "A1, worst station, from 9 s on", 0, 180, 200, 0.3, 12);
  claim("l1", "A2, station 4, until 6 s", 4, 6, 119, 3, 60);
  claim("l1", "A2, station 3, from 6 s on", 3, 120, 200, 2, 60);
  claim("dkf", "A3, worst station", 0, 1, 200, 3, 60);
  claim("sdlms", "A5, station 4, from 6 s on", 4, 120, 200, 0.3, 4);
  error_panels(found, laboratory, "px", "m");
  return found;
}

Findings velocities(Laboratory& laboratory) {
  Findings found;
  const auto claim = [&](const char* lane, const char* what, std::size_t to, double low, double high) {
    const auto records = records_of(laboratory, lane);
    found.runs = std::max(found.runs, static_cast<std::int64_t>(records->size()));
    found.claim(Reading::corrected, std::string("RMS of the error of vx at the worst station, m/s: ") + what, kSays,
                worst_of(*records, lane, "vx", 6, to), low, high);
  };
  claim("l1", "A2", 200, 0.04, 0.6);
  claim("omp_game", "A1, until 9 s", 179, 0, 0.1);
  claim("dkf", "A3", 200, 0, 0.1);
  claim("sdlms", "A5", 200, 0, 0.1);
  claim("etpg", "A4", 200, 0, 0.3);
  error_panels(found, laboratory, "vx", "m/s");
  return found;
}

/// Share of samples in which a station that the mask admits takes the estimate of an attacked one.
double share(const Record& record, int only, bool attacked_only, std::size_t from, std::size_t to) {
  double count = 0, bad = 0;
  for (int n = 1; n <= kNodes; ++n) {
    if (only != 0 && n != only) continue;
    for (std::size_t k = from; k <= to; ++k) {
      if (attacked_only && record.at("sensor." + std::to_string(n) + ".state", k) == 0) continue;
      const int chosen = static_cast<int>(record.at(signal("omp_game", n, "choice"), k)) + 1;
      ++count;
      bad += record.at("sensor." + std::to_string(chosen) + ".state", k) > 0 ? 1 : 0;
    }
  }
  return bad / count;
}

Findings choices(Laboratory& laboratory) {
  std::vector<std::string> names;
  for (int n = 1; n <= kNodes; ++n) {
    names.push_back(signal("omp_game", n, "choice"));
    names.push_back("sensor." + std::to_string(n) + ".state");
  }
  const auto records = laboratory.samples(preset("sparse", {"omp_game"}), names);
  const auto of = [&](int only, bool attacked_only, std::size_t from, std::size_t to) {
    return mean_of(of_runs(*records, [&](const Record& r) { return share(r, only, attacked_only, from, to); }));
  };
  Findings found;
  found.runs = static_cast<std::int64_t>(records->size());
  found.claim(Reading::corrected, "share of choices of an attacked station by attacked ones, 0.3 to 9 s",
              "never (a picture)", of(0, true, 6, 179), 0, 0.005);
  found.claim(Reading::noted, "the same of station 2 from 9.3 s on, when a majority is attacked", nullptr,
              of(2, false, 186, 200), 0, 1);
  for (int n = 1; n <= kNodes; ++n) {
    const Record& record = records->front();
    std::vector<double> chosen = record.of(signal("omp_game", n, "choice"));
    for (double& one : chosen) one += 1;
    const std::string title = "choice of station " + std::to_string(n);
    found.panels.push_back({title, {"k"}, {"station"}, {series(title, ticks(chosen.size()), chosen, "points", 6)}});
  }
  return found;
}

const char* const kReason =
    "The printed derivatives of azimuth and elevation are wrong, arctan loses the quadrant, and the utility (7) has a "
    "negative "
    "argument: all mended. Places of the stations, the graph and the constants of A3, A4 and A5 are not given. ";

Item item(const char* number, Words title, const char* rule, const char* more, Findings (*measure)(Laboratory&)) {
  return {std::string("001/fig") + number, std::move(title), "sparse, sections 13 and 14", "sparse", rule,
          std::string(kReason) + more,     measure};
}

}  // namespace

std::vector<Item> sparse_figures() {
  return {
      item("3", {"Tracks of the five algorithms", "五种算法的跟踪轨迹"},
           "After correction where A1 is on the truth until 9 s (RMS of px 0.05 m), station 4 leaves it under A2 and "
           "A4, A3 is "
           "off by metres and A5 close until 6 s.",
           "A1 fails in the last second.", tracks),
      item(
          "4", {"Errors of the x position", "x 方向位置误差"},
          "After correction where A1 has bursts only after 9 s, A2 is off by metres at stations 4 and 3 while they are "
          "attacked, A3 by metres, and A5 has an offset at station 4 after 6 s.",
          "A1 owes its accuracy to the game, not to the reconstruction.", positions),
      item("5", {"Errors of the x velocity", "x 方向速度误差"},
           "After correction where A2's error is 0.04 m/s at least at its worst station, those of A1 (until 9 s), A3 "
           "and A5 at "
           "most 0.1 and A4's at most 0.3 (RMS over a run).",
           "A2 puts false attacks into the velocities.", velocities),
      item("6", {"Whose estimate each station takes under A1", "A1 下各站点的选择"},
           "After correction where attacked stations take an attacked one's estimate in at most 0.5 % of samples from "
           "0.3 to 9 "
           "s.",
           "From 9.3 s on, with a majority attacked, the vote goes wrong.", choices)};
}

}  // namespace vigil::papers
