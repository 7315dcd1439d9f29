/// LogReader's runs, marks and what hangs on them.
#include <bit>

#include "db/reader_state.hpp"
#include "db/sort.hpp"

namespace vigil {

namespace {

const std::string kRunColumns =
    "SELECT "
    "run.id,scenario,family,title,state,seed,version,cpu,pace,input,trace,tags,note,created,started,ended,parent_run,"
    "parent_k,dt,steps,k,policy,keep,reproducible,document_hash,error,(SELECT count(*) FROM gap WHERE gap.run=run.id),"
    "(SELECT count(*) FROM command WHERE command.run=run.id)";

RunRow run_row(const Statement& query) {
  RunRow row;
  row.id = query.integer(0);
  row.scenario = query.text(1);
  row.family = query.text(2);
  row.title = Json::parse(query.text(3));
  row.state = query.text(4);
  row.seed = std::bit_cast<std::uint64_t>(query.integer(5));
  row.version = query.text(6);
  row.cpu = query.text(7);
  row.pace = Json::parse(query.text(8));
  row.input = Json::parse(query.text(9));
  row.trace = query.maybe_integer(10);
  row.tags = Json::parse(query.text(11)).get<std::vector<std::string>>();
  row.note = query.text(12);
  row.created = query.integer(13);
  row.started = query.maybe_integer(14);
  row.ended = query.maybe_integer(15);
  if (!query.null(16)) row.parent = RunParent{query.integer(16), query.integer(17)};
  row.dt = query.real(18);
  row.steps = query.maybe_integer(19);
  row.k = query.integer(20);
  row.policy = query.text(21) == "live" ? LogPolicy::live : LogPolicy::lossless;
  row.keep = query.maybe_real(22);
  row.reproducible = query.integer(23) != 0;
  row.document_hash = query.text(24);
  row.error = query.text(25);
  row.gaps = query.integer(26);
  row.changes = query.integer(27);
  return row;
}

std::vector<MetricValue> read_metrics(Database& database, RunId run, bool network_only) {
  auto query = database.cached(
      "SELECT lane,node,name,variant,value,boolean FROM metric WHERE run=?1 AND (?2=0 OR node='') ORDER BY position");
  query.all(run, network_only);
  std::vector<MetricValue> metrics;
  while (query.step()) {
    metrics.push_back(
        {query.text(0), query.text(1), query.text(2), query.text(3), query.real(4), query.integer(5) != 0});
  }
  return metrics;
}

std::vector<FaultCount> read_faults(Database& database, RunId run) {
  auto query =
      database.cached("SELECT lane,node,code,first,last,count,stopped,detail FROM fault WHERE run=? ORDER BY position");
  query.bind(1, run);
  std::vector<FaultCount> faults;
  while (query.step()) {
    faults.push_back({query.text(0), query.text(1), query.text(2), query.integer(3), query.integer(4), query.integer(5),
                      query.integer(6) != 0, query.text(7)});
  }
  return faults;
}

std::vector<Command> read_commands(Database& database, RunId run) {
  auto query = database.cached("SELECT k,body FROM command WHERE run=? ORDER BY id");
  query.bind(1, run);
  std::vector<Command> commands;
  while (query.step()) commands.push_back({query.integer(0), Json::parse(query.text(1))});
  return commands;
}

void read_document(Database& database, RunRow& row) {
  auto query = database.cached("SELECT body,design,world,warnings,designs FROM document WHERE run=?");
  if (!query.bind(1, row.id).step()) return;
  row.document = Json::parse(query.text(0));
  if (!query.null(1)) row.design = Json::parse(query.text(1));
  if (!query.null(2)) row.world = Json::parse(query.text(2));
  row.warnings = Json::parse(query.text(3)).get<std::vector<std::string>>();
  if (!query.null(4)) row.designs = Json::parse(query.text(4));
}

void bind_value(Statement& query, int index, const Query::Value& value) {
  std::visit([&](const auto& plain) { query.bind(index, plain); }, value);
}

}  // namespace

std::optional<RunRow> LogReader::run(RunId id) const {
  const auto database = state_->lease();
  Transaction transaction(*database, "BEGIN");
  auto query = database->cached(kRunColumns + " FROM run WHERE id=? AND deleted=0");
  if (!query.bind(1, id).step()) return std::nullopt;
  RunRow row = run_row(query);
  read_document(*database, row);
  row.metrics = read_metrics(*database, id, false);
  row.faults = read_faults(*database, id);
  row.commands = read_commands(*database, id);
  return row;
}

RunPage LogReader::list(const Query& filter, std::string_view sort, int limit, std::string_view cursor) const {
  if (limit < 1 || limit > 1000) throw QueryError(0, "limit is " + std::to_string(limit) + "; expected 1 to 1000.");
  auto values = filter.values();
  const RowOrder order(sort, cursor, values);
  const std::string sql = kRunColumns + "," + order.key() + " AS sort_key FROM run WHERE deleted=0 AND (" +
                          filter.sql() + ") AND " + order.after() + order.clause() + " LIMIT " +
                          std::to_string(limit + 1);
  const auto database = state_->lease();
  Transaction transaction(*database, "BEGIN");
  auto query = database->statement(sql);
  for (std::size_t i = 0; i < values.size(); ++i) bind_value(query, static_cast<int>(i) + 1, values[i]);
  RunPage page;
  std::string last;
  while (query.step()) {
    if (page.items.size() == static_cast<std::size_t>(limit)) {
      page.next = last;
      break;
    }
    RunRow row = run_row(query);
    row.metrics = read_metrics(*database, row.id, true);
    last = order.cursor_of(query, 28, row.id);
    page.items.push_back(std::move(row));
  }
  return page;
}

std::int64_t LogReader::count(const Query& filter) const {
  const auto database = state_->lease();
  auto query = database->statement("SELECT count(*) FROM run WHERE deleted=0 AND (" + filter.sql() + ")");
  for (std::size_t i = 0; i < filter.values().size(); ++i)
    bind_value(query, static_cast<int>(i) + 1, filter.values()[i]);
  return query.step() ? query.integer(0) : 0;
}

std::vector<Command> LogReader::commands(RunId run) const { return read_commands(*state_->lease(), run); }

std::vector<MetricValue> LogReader::metrics(RunId run) const { return read_metrics(*state_->lease(), run, false); }

std::vector<FaultCount> LogReader::faults(RunId run) const { return read_faults(*state_->lease(), run); }

}  // namespace vigil
