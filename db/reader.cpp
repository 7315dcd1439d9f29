#include "db/reader.hpp"

#include <filesystem>

#include "db/chunk.hpp"
#include "db/reader_state.hpp"
#include "db/schema.hpp"

namespace vigil {

LogReader::State::Lease LogReader::State::lease() const {
  {
    const std::scoped_lock lock(mutex);
    if (!idle.empty()) {
      auto database = std::move(idle.back());
      idle.pop_back();
      return Lease(*this, std::move(database));
    }
  }
  return Lease(*this, open_for_reading(path));
}

LogReader::LogReader(const std::string& path) : state_(std::make_unique<State>(path)) { state_->lease(); }

LogReader::~LogReader() = default;

namespace {

SignalKind kind_of(const std::string& name) {
  if (name == "bool") return SignalKind::boolean;
  return name == "category" ? SignalKind::category : SignalKind::scalar;
}

}  // namespace

std::vector<Signal> LogReader::signals(RunId run) const {
  const auto database = state_->lease();
  auto query = database->cached("SELECT id,name,unit,kind,lane,node,link,labels FROM signal WHERE run=? ORDER BY id");
  query.bind(1, run);
  std::vector<Signal> all;
  while (query.step()) {
    Signal& s = all.emplace_back();
    s.id = static_cast<int>(query.integer(0));
    s.name = query.text(1);
    s.unit = query.text(2);
    s.kind = kind_of(query.text(3));
    s.lane = query.text(4);
    s.node = query.text(5);
    s.link = query.text(6);
    for (const auto& label : Json::parse(query.text(7))) s.labels.emplace_back(label.at(0), label.at(1));
  }
  return all;
}

std::vector<int> LogReader::logged_signals(RunId run) const {
  const auto database = state_->lease();
  auto query = database->cached("SELECT id FROM signal WHERE run=? AND slot IS NOT NULL ORDER BY slot");
  query.bind(1, run);
  std::vector<int> ids;
  while (query.step()) ids.push_back(static_cast<int>(query.integer(0)));
  return ids;
}

std::vector<ScenarioRow> LogReader::scenarios() const {
  const auto database = state_->lease();
  auto query = database->cached("SELECT id,document,created,updated FROM scenario ORDER BY id");
  std::vector<ScenarioRow> rows;
  while (query.step()) rows.push_back({query.text(0), parsed(query.text(1)), query.integer(2), query.integer(3)});
  return rows;
}

std::optional<ScenarioRow> LogReader::scenario(const std::string& id) const {
  const auto database = state_->lease();
  auto query = database->cached("SELECT id,document,created,updated FROM scenario WHERE id=?");
  if (!query.bind(1, id).step()) return std::nullopt;
  return ScenarioRow{query.text(0), parsed(query.text(1)), query.integer(2), query.integer(3)};
}

namespace {

TraceRow trace_row(const Statement& query) {
  TraceRow row;
  row.id = query.integer(0);
  row.name = query.text(1);
  row.hash = query.text(2);
  row.rows = query.integer(3);
  row.columns = Json::parse(query.text(4)).get<std::vector<std::string>>();
  row.bytes = query.integer(5);
  row.created = query.integer(6);
  return row;
}

const std::string kTraceColumns = "SELECT id,name,hash,rows,columns,bytes,created FROM trace ";

}  // namespace

std::vector<TraceRow> LogReader::traces() const {
  const auto database = state_->lease();
  auto query = database->cached(kTraceColumns + "ORDER BY id DESC");
  std::vector<TraceRow> rows;
  while (query.step()) rows.push_back(trace_row(query));
  return rows;
}

std::optional<TraceRow> LogReader::trace(std::int64_t id) const {
  const auto database = state_->lease();
  auto query = database->cached(kTraceColumns + "WHERE id=?");
  if (!query.bind(1, id).step()) return std::nullopt;
  return trace_row(query);
}

std::optional<std::string> LogReader::trace_csv(std::int64_t id) const {
  const auto database = state_->lease();
  auto query = database->cached("SELECT csv FROM trace WHERE id=?");
  if (!query.bind(1, id).step()) return std::nullopt;
  return decompress_text(query.bytes(0));
}

std::optional<DesignRow> LogReader::design(const std::string& key) const {
  const auto database = state_->lease();
  auto query = database->cached("SELECT key,lane,record,created FROM design WHERE key=?");
  if (!query.bind(1, key).step()) return std::nullopt;
  return DesignRow{query.text(0), query.text(1), Json::parse(query.text(2)), query.integer(3)};
}

std::optional<std::string> LogReader::design_problem(const std::string& key) const {
  const auto database = state_->lease();
  auto query = database->cached("SELECT problem FROM design WHERE key=?");
  if (!query.bind(1, key).step()) return std::nullopt;
  return decompress_text(query.bytes(0));
}

Json LogReader::setting(const std::string& key) const {
  const auto database = state_->lease();
  auto query = database->cached("SELECT value FROM setting WHERE key=?");
  return query.bind(1, key).step() ? parsed(query.text(0)) : Json();
}

LogCounts LogReader::counts() const {
  const auto database = state_->lease();
  LogCounts counts;
  auto states = database->cached("SELECT state,count(*) FROM run WHERE deleted=0 GROUP BY state ORDER BY state");
  while (states.step()) {
    counts.by_state.emplace_back(states.text(0), states.integer(1));
    counts.runs += states.integer(1);
  }
  auto blocks = database->cached("SELECT count(*) FROM block");
  if (blocks.step()) counts.blocks = blocks.integer(0);
  for (const char* suffix : {"", "-wal"}) {
    std::error_code missing;
    const auto size = std::filesystem::file_size(state_->path + suffix, missing);
    if (!missing) counts.bytes += static_cast<std::int64_t>(size);
  }
  return counts;
}

}  // namespace vigil
