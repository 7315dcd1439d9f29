#include "server/compare/metric_rows.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "engine/metrics/paired.hpp"

namespace vigil {
namespace {

using Key = std::tuple<std::string, std::string, std::string, std::string>;  // lane, node, name, variant

struct Table {
  std::vector<Key> rows;                                 ///< in order of appearance
  std::vector<std::map<Key, const MetricValue*>> cells;  ///< one a run
};

Table tabulate(const std::vector<ComparedRun>& runs) {
  Table table;
  std::map<Key, bool> known;
  for (const ComparedRun& run : runs) {
    auto& column = table.cells.emplace_back();
    for (const MetricValue& metric : run.metrics) {
      const Key key{metric.lane, metric.node, metric.name, metric.variant};
      column[key] = &metric;
      if (known.emplace(key, true).second) table.rows.push_back(key);
    }
  }
  return table;
}

Json text_or_null(const std::string& text) { return text.empty() ? Json() : Json(text); }

Json named(const Key& key) {
  const auto& [lane, node, name, variant] = key;
  return {{"lane", lane}, {"node", text_or_null(node)}, {"name", name}, {"variant", text_or_null(variant)}};
}

double number(const std::map<Key, const MetricValue*>& column, const Key& key) {
  const auto place = column.find(key);
  const bool there = place != column.end() && !place->second->boolean;
  return there ? place->second->value : std::nan("");
}

/// Runs that differ by nothing but their seed.
struct Group {
  std::string what;
  std::map<std::uint64_t, std::size_t> by_seed;  ///< first run of each seed
};

std::vector<Group> groups(const std::vector<ComparedRun>& runs) {
  std::vector<Group> all;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (!runs[i].seed || !runs[i].document.is_object()) continue;
    Json what = runs[i].document;
    what["input"] = runs[i].input;
    for (const Command& command : runs[i].live) what["commands"].push_back({command.k, command.body});
    const std::string text = what.dump();
    auto place = std::find_if(all.begin(), all.end(), [&](const Group& group) { return group.what == text; });
    if (place == all.end()) place = all.insert(all.end(), {text, {}});
    place->by_seed.emplace(*runs[i].seed, i);
  }
  return all;
}

}  // namespace

Json finite_json(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json paired_json(const PairedDifference& paired) {
  Json json{{"mean", finite_json(paired.mean)}, {"se", finite_json(paired.se)}, {"n", paired.n}};
  json["ci"] = std::isfinite(paired.lo) && std::isfinite(paired.hi) ? Json{paired.lo, paired.hi} : Json();
  json["p"] = finite_json(paired.p);
  if (paired.batches > 0) {
    json["batches"] = paired.batches;
    json["lag1"] = finite_json(paired.lag1);
  }
  return json;
}

Json metric_rows(const std::vector<ComparedRun>& runs) {
  const Table table = tabulate(runs);
  Json rows = Json::array();
  for (const Key& key : table.rows) {
    Json row = named(key);
    row["values"] = Json::array();
    row["difference"] = Json::array();
    const double first = number(table.cells[0], key);
    for (const auto& column : table.cells) {
      const auto place = column.find(key);
      row["values"].push_back(place == column.end() ? Json() : to_json(*place->second).at("value"));
      row["difference"].push_back(finite_json(number(column, key) - first));
    }
    row["difference"][0] = nullptr;
    rows.push_back(std::move(row));
  }
  return rows;
}

Json paired_metrics(const std::vector<ComparedRun>& runs) {
  const Table table = tabulate(runs);
  const std::vector<Group> all = groups(runs);
  Json rows = Json::array();
  for (std::size_t other = 1; other < all.size(); ++other) {
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (const auto& [seed, run] : all[other].by_seed) {
      const auto place = all[0].by_seed.find(seed);
      if (place != all[0].by_seed.end()) pairs.emplace_back(place->second, run);
    }
    if (pairs.size() < 2) continue;
    Json ids = Json::array();
    for (const auto& [a, b] : pairs) ids.push_back({runs[a].id, runs[b].id});
    for (const Key& key : table.rows) {
      std::vector<double> a, b;
      for (const auto& [one, two] : pairs) {
        a.push_back(number(table.cells[one], key));
        b.push_back(number(table.cells[two], key));
      }
      const PairedDifference paired = paired_difference(a, b);
      if (paired.n < 2) continue;
      Json row = paired_json(paired);
      row["metric"] = named(key);
      row["against"] = runs[pairs.front().second].id;
      row["pairs"] = ids;
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

}  // namespace vigil
