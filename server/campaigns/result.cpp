#include "server/campaigns/result.hpp"

#include <algorithm>
#include <cmath>

namespace vigil {
namespace {

std::string text(const Json& value) { return value.is_null() ? "" : value.get<std::string>(); }

/// A field of a CSV file: in quotes where it must be.
std::string field(const Json& value) {
  if (value.is_null()) return "";
  std::string text = value.is_string() ? value.get<std::string>() : value.dump();
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

}  // namespace

Json rows_of(const std::vector<CellResult>& cells, const char* key) {
  Json rows = Json::array();
  for (const CellResult& cell : cells) {
    if (cell.result.is_null()) continue;
    for (const Json& row : cell.result.at(key)) {
      rows.push_back(row);
      rows.back()["sweep"] = cell.sweep;
    }
  }
  return rows;
}

Json designs_of(const std::vector<CellResult>& cells) {
  const auto design = [](const CellResult& cell) { return cell.result.is_null() ? Json() : cell.result.at("design"); };
  if (cells.size() == 1) return design(cells.front());
  Json list = Json::array();
  for (const CellResult& cell : cells) list.push_back({{"sweep", cell.sweep}, {"design", design(cell)}});
  return list;
}

Json warnings_of(const std::vector<CellResult>& cells) {
  Json all = Json::array();
  for (const CellResult& cell : cells) {
    if (cell.result.is_null()) continue;
    for (const Json& warning : cell.result.at("warnings")) {
      if (std::find(all.begin(), all.end(), warning) == all.end()) all.push_back(warning);
    }
  }
  return all;
}

Json trials_of(const std::vector<CellResult>& cells) {
  Json sum{{"finished", 0}, {"stopped", 0}, {"failed", 0}};
  for (const CellResult& cell : cells) {
    if (cell.result.is_null()) continue;
    for (auto& [state, count] : sum.items())
      count = count.get<std::int64_t>() + cell.result.at("trials").at(state).get<std::int64_t>();
  }
  return sum;
}

std::vector<MetricSummary> summaries_of(const Json& metrics) {
  const auto number = [](const Json& value) { return value.is_null() ? std::nan("") : value.get<double>(); };
  std::vector<MetricSummary> summaries;
  for (const Json& row : metrics) {
    MetricSummary& summary = summaries.emplace_back();
    summary.key = {text(row.at("lane")), text(row.at("node")), row.at("name"), text(row.at("variant")), 0, false};
    summary.mean = number(row.at("mean"));
    summary.se = number(row.at("se"));
    summary.n = row.at("n");
  }
  return summaries;
}

std::vector<FaultCount> faults_of(const Json& faults) {
  std::vector<FaultCount> all;
  for (const Json& row : faults) {
    all.push_back({text(row.at("lane")), text(row.at("node")), text(row.at("code")), row.at("first"), row.at("last"),
                   row.at("count"), row.value("stopped", false), text(row.value("detail", Json()))});
  }
  return all;
}

std::string results_csv(const std::vector<CellResult>& cells) {
  static const std::vector<std::string> kFigures{"mean", "se", "median", "min", "max", "n"};
  static const std::vector<std::string> kQuantiles{"0.05", "0.25", "0.75", "0.95"};
  std::string text = "cell";
  if (!cells.empty()) {
    for (const auto& [path, value] : cells.front().sweep.items()) text += "," + field(path);
  }
  text += ",lane,node,name,variant";
  for (const std::string& figure : kFigures) text += "," + figure;
  for (const std::string& p : kQuantiles) text += ",q" + p;
  text += "\r\n";
  for (const CellResult& cell : cells) {
    if (cell.result.is_null()) continue;
    for (const Json& row : cell.result.at("metrics")) {
      text += std::to_string(cell.cell);
      for (const auto& [path, value] : cell.sweep.items()) text += "," + field(value);
      for (const char* key : {"lane", "node", "name", "variant"}) text += "," + field(row.at(key));
      for (const std::string& figure : kFigures) text += "," + field(row.at(figure));
      for (const std::string& p : kQuantiles) text += "," + field(row.at("quantiles").at(p));
      text += "\r\n";
    }
  }
  return text;
}

}  // namespace vigil
