#include "db/cell_summary.hpp"

#include <limits>

#include "db/chunk.hpp"
#include "engine/core/bytes.hpp"

namespace vigil {
namespace {

std::string text(const Json& row, const char* key) {
  const auto place = row.find(key);
  return place == row.end() || place->is_null() ? "" : place->get<std::string>();
}

CellSummary::Row row_of(const Json& metric) {
  CellSummary::Row row{text(metric, "lane"), text(metric, "node"), text(metric, "name"), text(metric, "variant"), {}};
  const Json& quantiles = metric.at("quantiles");
  for (std::size_t i = 0; i < kSummaryFigures.size(); ++i) {
    const Json& value = (quantiles.contains(kSummaryFigures[i]) ? quantiles : metric).at(kSummaryFigures[i]);
    row.figures[i] = value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
  }
  return row;
}

}  // namespace

CellSummary cell_summary(const Json& result) {
  CellSummary summary;
  summary.trials = result.value("trials", Json::object());
  summary.ticks = result.value("ticks", std::int64_t{0});
  summary.warnings = result.value("warnings", Json::array());
  if (const auto metrics = result.find("metrics"); metrics != result.end()) {
    for (const Json& metric : *metrics) summary.rows.push_back(row_of(metric));
  }
  return summary;
}

std::string encode(const CellSummary& summary) {
  ByteWriter out;
  out.text(Json{{"trials", summary.trials}, {"ticks", summary.ticks}, {"warnings", summary.warnings}}.dump());
  out.word(summary.rows.size());
  for (const CellSummary::Row& row : summary.rows) {
    for (const std::string* word : {&row.lane, &row.node, &row.name, &row.variant}) out.text(*word);
    for (const double figure : row.figures) out.number(figure);
  }
  return compress_text(out.take());
}

CellSummary decode_summary(std::string_view bytes) {
  const std::string plain = decompress_text(bytes);
  ByteReader in(plain);
  CellSummary summary = cell_summary(Json::parse(in.text()));
  summary.rows.resize(in.count(8 * (4 + kSummaryFigures.size())));
  for (CellSummary::Row& row : summary.rows) {
    for (std::string* word : {&row.lane, &row.node, &row.name, &row.variant}) *word = in.text();
    for (double& figure : row.figures) figure = in.number();
  }
  if (!in.done()) throw std::runtime_error("A point's summary has something left over.");
  return summary;
}

}  // namespace vigil
