/// Seed 001: the network, the attacks of table 1 and the errors of table 2.
#include "engine/papers/sparse.hpp"

#include <algorithm>
#include <cmath>

#include "engine/papers/curves.hpp"
#include "engine/run/run.hpp"

namespace vigil::papers {
namespace {

const char* const kId = "sparse";
constexpr std::size_t kNodes = 5;

Findings network(Laboratory& laboratory) {
  RunOptions options;
  options.seed = laboratory.first_seed();
  const Json world = Run(preset(kId, {"omp_game"}), std::move(options)).world();
  std::vector<bool> reached(kNodes, false);
  reached[0] = true;
  Panel panel{"stations and channels", {"x (m)"}, {"y (m)"}, {}};
  Series stations{"stations", {}, {}, "points"};
  for (const Json& node : world["nodes"]) {
    stations.x.push_back(node["position"][0].get<double>());
    stations.y.push_back(node["position"][1].get<double>());
  }
  const auto index = [](const Json& id) { return static_cast<std::size_t>(std::stoi(id.get<std::string>()) - 1); };
  double one_way = 0;
  for (const Json& link : world["links"]) {
    const std::size_t a = index(link["from"]), b = index(link["to"]);
    one_way += a < b ? 1 : -1;
    if (a < b) panel.series.push_back({"", {stations.x[a], stations.x[b]}, {stations.y[a], stations.y[b]}, "edge"});
  }
  for (std::size_t pass = 0; pass < kNodes; ++pass) {
    for (const Json& link : world["links"]) {
      if (reached[index(link["from"])]) reached[index(link["to"])] = true;
    }
  }
  Findings found;
  found.runs = 1;
  const auto count = static_cast<double>(std::count(reached.begin(), reached.end(), true));
  found.claim(Reading::printed, "stations", 5, {static_cast<double>(stations.x.size())}, 5, 5);
  found.claim(Reading::printed, "stations that station 1 reaches, itself included", 5, {count}, 5, 5);
  found.claim(Reading::printed, "channels without their way back", 0, {std::abs(one_way)}, 0, 0);
  panel.series.push_back(std::move(stations));
  found.panels.push_back(std::move(panel));
  return found;
}

struct Period {
  std::size_t node;
  double start, end;  ///< s
  double state;       ///< 4: type I, 5: type II
};

/// Table 1 as printed, its empty column left out.
const std::vector<Period> kTable{{1, 9, 10, 4}, {2, 0, 6, 4}, {3, 6, 10, 5}, {4, 0, 6, 5}, {5, 6, 10, 4}};

Findings schedule(Laboratory& laboratory) {
  std::vector<std::string> signals;
  for (std::size_t n = 1; n <= kNodes; ++n) signals.push_back("sensor." + std::to_string(n) + ".state");
  const auto records = laboratory.samples(preset(kId, {"ekf"}), signals, 1);
  const Record& record = records->front();
  double wrong = 0, attacked = 0;
  Panel panel{"attacked stations", {"t (s)"}, {"station"}, {}};
  for (const Period& period : kTable) {
    Series stripe{"station " + std::to_string(period.node), {}, {}, "points"};
    for (std::size_t k = 1; k < record.ticks(); ++k) {
      const double state = record.at(signals[period.node - 1], k), t = record.time[k];
      const bool inside = t > period.start - 1e-9 && (t < period.end - 1e-9 || period.end == 10);
      wrong += state == (inside ? period.state : 0) ? 0 : 1;
      attacked += state > 0 ? 1 : 0;
      if (state <= 0) continue;
      stripe.x.push_back(t);
      stripe.y.push_back(static_cast<double>(period.node));
    }
    panel.series.push_back(std::move(stripe));
  }
  Findings found;
  found.runs = 1;
  found.claim(Reading::printed, "samples of 1000 whose attack is not that of table 1", 0, {wrong}, 0, 0);
  found.claim(Reading::noted, "samples of 1000 that are attacked", nullptr, {attacked}, 1, 1000);
  found.panels.push_back(std::move(panel));
  return found;
}

/// Table 2 as printed: mean squared error of px, m^2, A1 to A5 by station.
constexpr double kPrinted[5][kNodes] = {{0.0724, 0.0150, 0.0724, 1.3807, 0.0054},
                                        {0.0238, 7.2185, 0.2550, 40.6553, 0.4213},
                                        {28.6083, 33.0688, 29.0511, 29.5093, 31.6166},
                                        {0.0302, 8.3714, 0.3338, 39.4624, 0.1078},
                                        {3.6060, 3.5778, 3.6056, 3.5778, 3.5785}};

Findings errors(Laboratory& laboratory) {
  Findings found;
  Panel panel{"mean squared error of px", {"station"}, {"m²", true}, {}};
  std::vector<std::shared_ptr<const Study>> studies;
  for (std::size_t a = 0; a < kAlgorithms.size(); ++a) {
    const std::string& lane = kAlgorithms[a];
    studies.push_back(laboratory.campaign(preset(kId, {lane}), sparse_runs(laboratory, lane)));
    found.runs = std::max(found.runs, studies.back()->runs);
    const std::string name = "A" + std::to_string(a + 1);
    Series ours{name, {}, {}, "points"}, theirs{name + ", printed", {}, {}, "dashed"};
    for (std::size_t n = 0; n < kNodes; ++n) {
      const Estimate error = studies.back()->at(lane, "mse_px", std::to_string(n + 1));
      const double paper = kPrinted[a][n];
      found.claim(Reading::corrected, "mean squared error of px, " + name + ", station " + std::to_string(n + 1), paper,
                  error, paper / 3, 3 * paper);
      ours.x.push_back(static_cast<double>(n + 1));
      ours.y.push_back(error.value);
      theirs.y.push_back(paper);
    }
    theirs.x = ours.x;
    panel.series.push_back(std::move(ours));
    panel.series.push_back(std::move(theirs));
  }
  const auto at = [&](std::size_t a, const char* node) { return studies[a]->at(kAlgorithms[a], "mse_px", node).value; };
  found.claim(Reading::noted, "A2 over A1, station 4", kPrinted[1][3] / kPrinted[0][3], {at(1, "4") / at(0, "4")}, 5,
              1e9);
  found.claim(Reading::noted, "A4 over A1, station 4", kPrinted[3][3] / kPrinted[0][3], {at(3, "4") / at(0, "4")}, 5,
              1e9);
  const auto none = laboratory.campaign(preset(kId, {"pred"}));
  found.claim(Reading::noted, "no sensor at all (not in the source)", nullptr, none->at("pred", "mse_px", "1"), 0, 1);
  found.panels.push_back(std::move(panel));
  return found;
}

}  // namespace

std::int64_t sparse_runs(const Laboratory& laboratory, const std::string& lane) {
  return lane == "l1" || lane == "etpg" ? std::min<std::int64_t>(laboratory.runs(), 40) : laboratory.runs();
}

std::vector<Item> sparse_items() {
  std::vector<Item> list{
      {"001/fig2",
       {"The network of five stations", "五个雷达站的网络"},
       "sparse, sections 4 and 6",
       kId,
       "Reproduced where five stations form a connected undirected graph, which is all that the text says.",
       "The picture is missing and the stations' places are not given: graph and places are ours, and results depend "
       "strongly on them.",
       network},
      {"001/table1",
       {"When each station is attacked", "各雷达站受攻击的时段"},
       "sparse, section 5",
       kId,
       "Reproduced where every sample of a run is attacked as table 1 says.",
       "The scanned table has an empty column, an artefact of its layout. A majority is attacked in the last second.",
       schedule},
      {"001/table2",
       {"Mean squared errors of five algorithms at five stations", "五种算法在五个站点的均方误差"},
       "sparse, section 13",
       kId,
       "After correction where each of the 25 cells is within a factor of 3 of the printed one.",
       "A1's magnitude and its worst station come out, and so do its lead over A2 and A4 at station 4 and A3's poor "
       "errors. "
       "A2 and A4 at station 3 depend on places that are not given; A3's nearly equal errors point to another "
       "exchange; A5's "
       "constants are not given, and ours is better than A1 at three stations. Doing without any sensor beats every "
       "algorithm "
       "at the attacked stations.",
       errors}};
  const auto figures = sparse_figures();
  list.insert(list.begin() + 1, figures.begin(), figures.end());
  return list;
}

}  // namespace vigil::papers
