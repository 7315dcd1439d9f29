#include "engine/identify/mapping.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/adversary/attack.hpp"
#include "engine/core/describe.hpp"
#include "engine/core/input_error.hpp"
#include "engine/core/params.hpp"
#include "engine/identify/table.hpp"
#include "engine/run/frame_csv.hpp"

namespace vigil::identify {
namespace {

const std::vector<std::string> kKeys{"dt", "columns", "constants", "input_lag", "label"};

const Json& expect(const Json& value, bool holds, const std::string& pointer, const std::string& expected) {
  if (!holds)
    throw InputError(pointer, fmt::format("{} is {}; expected {}", pointer, shown(value), expected), expected);
  return value;
}

/// A signal that a trace may carry: its columns have no blanks and no quotes.
void check_signal(const std::string& signal, const std::string& pointer) {
  const bool plain = std::all_of(signal.begin(), signal.end(), [](char c) {
    return static_cast<unsigned char>(c) > 0x20U && c != '"' && c != ',' && c != 0x7F;
  });
  if (!plain || signal.empty() || signal == "k" || signal == "t")
    throw InputError(pointer,
                     in_quotes(signal) + " is no signal of a trace; expected a name like sensor.1.y1 or input.u1");
}

void read_label(const Json& label, const std::string& pointer, Mapping& mapping) {
  expect(label, label.is_object() && label.contains("column") && label.contains("nodes"), pointer,
         "{\"column\",\"nodes\"}");
  mapping.label = expect(label["column"], label["column"].is_string(), pointer + "/column", "the name of a column")
                      .get<std::string>();
  expect(label["nodes"], label["nodes"].is_array(), pointer + "/nodes", "a list of node ids");
  for (const Json& node : label["nodes"]) {
    expect(node, node.is_string(), pointer + "/nodes", "a list of node ids");
    mapping.labelled.push_back(node.get<std::string>());
    check_signal(mapping.labelled.back(), pointer + "/nodes");
  }
}

/// Table and mapping side by side: where each signal's numbers stand.
class Writer {
 public:
  Writer(std::string_view text, const Mapping& mapping) : mapping_(mapping), table_(read_table(text, wanted(mapping))) {
    const auto add = [&](const std::string& name) {
      if (catalogue_.find(name) >= 0)
        throw InputError(child("/columns", name), in_quotes(name) + " is mapped twice; expected each signal once");
      catalogue_.add({.name = name});
    };
    for (const auto& [signal, column] : mapping.columns) add(signal);
    for (const auto& [signal, value] : mapping.constants) add(signal);
    for (const std::string& node : mapping.labelled) add("sensor." + node + ".state");
  }

  std::string write() {
    std::string csv = csv_header(catalogue_);
    Frame frame;
    for (Eigen::Index k = 0; k < table_.values.rows(); ++k) {
      frame.k = k;
      frame.t = static_cast<double>(k) * mapping_.dt;
      fill(k, frame.values);
      append_csv_row(csv, frame);
    }
    return csv;
  }

 private:
  static std::vector<std::string> wanted(const Mapping& mapping) {
    std::vector<std::string> columns;
    for (const auto& [signal, column] : mapping.columns) columns.push_back(column);
    if (!mapping.label.empty()) columns.push_back(mapping.label);
    return columns;
  }

  void fill(Eigen::Index k, std::vector<double>& values) const {
    values.clear();
    for (std::size_t c = 0; c < mapping_.columns.size(); ++c) {
      const bool input = mapping_.columns[c].first.starts_with("input.");
      const Eigen::Index row = k - (input ? mapping_.input_lag : 0);
      values.push_back(row < 0 ? std::numeric_limits<double>::quiet_NaN()
                               : table_.values(row, static_cast<Eigen::Index>(c)));
    }
    for (const auto& [signal, value] : mapping_.constants) values.push_back(value);
    if (mapping_.label.empty()) return;
    const bool attacked = table_.values(k, table_.values.cols() - 1) > 0;
    const SensorState state = attacked ? SensorState::fdi : SensorState::clean;
    values.resize(values.size() + mapping_.labelled.size(), static_cast<double>(state));
  }

  const Mapping& mapping_;
  Table table_;
  Catalogue catalogue_;
};

}  // namespace

Mapping read_mapping(const Json& value, const std::string& pointer) {
  expect(value, value.is_object() && value.contains("columns"), pointer, "an object with \"columns\"");
  for (const auto& [key, ignored] : value.items()) {
    if (std::find(kKeys.begin(), kKeys.end(), key) != kKeys.end()) continue;
    throw InputError(child(pointer, key),
                     fmt::format("unknown key {}; expected one of {}", in_quotes(key), listed(kKeys)),
                     nearest(key, kKeys));
  }
  Mapping mapping;
  const Json dt = value.value("dt", Json(1.0)), lag = value.value("input_lag", Json(0));
  mapping.dt = expect(dt, dt.is_number() && dt.get<double>() > 0, pointer + "/dt", "a number above 0").get<double>();
  mapping.input_lag = expect(lag, lag == 0 || lag == 1, pointer + "/input_lag", "0 or 1").get<int>();
  const Json columns = value["columns"], constants = value.value("constants", Json::object());
  expect(columns, columns.is_object() && !columns.empty(), pointer + "/columns", "{\"<signal>\":\"<column>\"}");
  for (const auto& [signal, column] : columns.items()) {
    const std::string place = child(pointer + "/columns", signal);
    check_signal(signal, place);
    expect(column, column.is_string(), place, "the name of a column");
    mapping.columns.emplace_back(signal, column.get<std::string>());
  }
  expect(constants, constants.is_object(), pointer + "/constants", "{\"<signal>\":number}");
  for (const auto& [signal, number] : constants.items()) {
    const std::string place = child(pointer + "/constants", signal);
    check_signal(signal, place);
    mapping.constants.emplace_back(signal, expect(number, number.is_number(), place, "a number").get<double>());
  }
  if (value.contains("label") && !value["label"].is_null()) read_label(value["label"], pointer + "/label", mapping);
  return mapping;
}

Json to_json(const Mapping& mapping) {
  Json result{{"dt", mapping.dt}, {"columns", Json::object()}, {"constants", Json::object()}};
  for (const auto& [signal, column] : mapping.columns) result["columns"][signal] = column;
  for (const auto& [signal, value] : mapping.constants) result["constants"][signal] = value;
  result["input_lag"] = mapping.input_lag;
  if (!mapping.label.empty()) result["label"] = {{"column", mapping.label}, {"nodes", mapping.labelled}};
  return result;
}

std::string table_to_trace(std::string_view text, const Mapping& mapping) { return Writer(text, mapping).write(); }

}  // namespace vigil::identify
