#include "server/cli/report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>

namespace vigil {
namespace {

/// Characters, not bytes: continuation bytes of UTF-8 take no room.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

template <class T>
std::size_t place(std::vector<T>& list, const T& item) {
  const auto found = std::find(list.begin(), list.end(), item);
  if (found != list.end()) return static_cast<std::size_t>(found - list.begin());
  list.push_back(item);
  return list.size() - 1;
}

/// Collects cells that come in any order into rows by lane and columns by metric.
class LaneTable {
 public:
  void put(const MetricValue& key, std::string text) {
    const std::string column = key.variant.empty() ? key.name : key.name + ":" + key.variant;
    cells_[{place(lanes_, key.lane), place(columns_, column)}] = std::move(text);
  }
  std::string text() const {
    std::vector<std::vector<std::string>> rows{{"lane"}};
    rows.front().insert(rows.front().end(), columns_.begin(), columns_.end());
    for (std::size_t lane = 0; lane < lanes_.size(); ++lane) {
      std::vector<std::string> row{lanes_[lane]};
      for (std::size_t column = 0; column < columns_.size(); ++column) {
        const auto cell = cells_.find({lane, column});
        row.push_back(cell == cells_.end() ? "" : cell->second);
      }
      rows.push_back(std::move(row));
    }
    return aligned(rows);
  }

 private:
  std::vector<std::string> lanes_, columns_;
  std::map<std::pair<std::size_t, std::size_t>, std::string> cells_;
};

std::string value_text(const MetricValue& metric) {
  if (!metric.boolean || !std::isfinite(metric.value)) return six_digits(metric.value);
  return metric.value != 0 ? "yes" : "no";
}

}  // namespace

std::string aligned(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()), 0);
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width(row[i]));
  }
  std::string text;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string space(widths[i] - width(row[i]), ' ');
      line += (i == 0 ? "" : "  ");
      line += i == 0 ? row[i] + space : space + row[i];
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line;
    text += '\n';
  }
  return text;
}

std::string six_digits(double value) {
  if (!std::isfinite(value)) return "-";
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::string metric_table(const std::vector<MetricValue>& metrics) {
  LaneTable table;
  for (const MetricValue& metric : metrics) {
    if (metric.node.empty()) table.put(metric, value_text(metric));
  }
  return table.text();
}

std::string summary_table(const std::vector<MetricSummary>& metrics) {
  LaneTable table;
  for (const MetricSummary& metric : metrics) {
    if (!metric.key.node.empty()) continue;
    const std::string error = std::isfinite(metric.se) && metric.se > 0 ? " +- " + six_digits(metric.se) : "";
    table.put(metric.key, metric.n == 0 ? "-" : six_digits(metric.mean) + error);
  }
  return table.text();
}

std::string fault_lines(const std::vector<FaultCount>& faults) {
  struct Sum {
    std::int64_t count = 0, first = 0, last = 0;
    std::set<std::string> nodes;
    bool stopped = false;
  };
  std::vector<std::pair<std::string, std::string>> order;
  std::vector<Sum> sums;
  for (const FaultCount& fault : faults) {
    const std::size_t index = place(order, std::pair(fault.lane, fault.code));
    if (index == sums.size()) sums.push_back({0, fault.first, fault.last, {}, false});
    Sum& sum = sums[index];
    sum.count += fault.count;
    sum.first = std::min(sum.first, fault.first);
    sum.last = std::max(sum.last, fault.last);
    sum.stopped = sum.stopped || fault.stopped;
    if (!fault.node.empty()) sum.nodes.insert(fault.node);
  }
  std::vector<std::vector<std::string>> rows{{"fault", "code", "count", "nodes", "first", "last", ""}};
  for (std::size_t i = 0; i < sums.size(); ++i) {
    rows.push_back({order[i].first, order[i].second, std::to_string(sums[i].count),
                    std::to_string(sums[i].nodes.size()), std::to_string(sums[i].first), std::to_string(sums[i].last),
                    sums[i].stopped ? "stopped the lane" : ""});
  }
  return sums.empty() ? std::string() : aligned(rows);
}

bool any_stopped(const std::vector<FaultCount>& faults) {
  return std::any_of(faults.begin(), faults.end(), [](const FaultCount& fault) { return fault.stopped; });
}

}  // namespace vigil
