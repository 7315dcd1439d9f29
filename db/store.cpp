#include "db/store.hpp"

#include <bit>

namespace vigil {

namespace {

template <class Value, class Dump>
void set_column(Database& database, RunId run, const char* sql, const std::optional<Value>& value, Dump to_column) {
  if (value) database.cached(sql).all(to_column(*value), run).run();
}

void replace_metrics(Database& database, RunId run, const std::vector<MetricValue>& metrics) {
  database.cached("DELETE FROM metric WHERE run=?").bind(1, run).run();
  auto insert =
      database.cached("INSERT INTO metric(run,position,lane,node,name,variant,value,boolean) VALUES(?,?,?,?,?,?,?,?)");
  std::int64_t position = 0;
  for (const auto& m : metrics)
    insert.all(run, position++, m.lane, m.node, m.name, m.variant, m.value, m.boolean).run();
}

void replace_faults(Database& database, RunId run, const std::vector<FaultCount>& faults) {
  database.cached("DELETE FROM fault WHERE run=?").bind(1, run).run();
  auto insert = database.cached(
      "INSERT INTO fault(run,position,lane,node,code,first,last,count,stopped,detail) VALUES(?,?,?,?,?,?,?,?,?,?)");
  std::int64_t position = 0;
  for (const auto& f : faults) {
    insert.all(run, position++, f.lane, f.node, f.code, f.first, f.last, f.count, f.stopped, f.detail).run();
  }
}

const char* kind_name(SignalKind kind) {
  switch (kind) {
    case SignalKind::boolean:
      return "bool";
    case SignalKind::category:
      return "category";
    default:
      return "scalar";
  }
}

}  // namespace

std::string dump(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

RunId insert_run(Database& database, const RunRecord& r, WallTime now) {
  const Json title = r.document.is_object() ? r.document.value("title", Json()) : Json();
  const auto parent_run = r.parent ? std::optional(r.parent->run) : std::nullopt;
  const auto parent_k = r.parent ? std::optional(r.parent->k) : std::nullopt;
  database
      .cached(
          "INSERT INTO run(scenario,family,title,state,seed,version,cpu,pace,input,trace,tags,note,created,parent_run,"
          "parent_k,dt,steps,policy,keep,reproducible,document_hash) VALUES(?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)")
      .all(r.scenario, r.family, dump(title), r.state, std::bit_cast<std::int64_t>(r.seed), r.version, r.cpu,
           dump(r.pace), dump(r.input), r.trace, dump(r.tags), r.note, now, parent_run, parent_k, r.dt, r.steps,
           to_string(r.policy), r.keep, r.reproducible, r.document_hash)
      .run();
  const RunId id = database.last_id();
  const auto designs = r.designs.is_null() ? std::nullopt : std::optional(dump(r.designs));
  database.cached("INSERT INTO document(run,body,designs) VALUES(?,?,?)").all(id, dump(r.document), designs).run();
  if (!r.idempotency_key.empty()) {
    database.cached("INSERT OR REPLACE INTO idempotency(key,hash,run,created) VALUES(?,?,?,?)")
        .all(r.idempotency_key, r.idempotency_hash, id, now)
        .run();
  }
  return id;
}

std::optional<RunId> known_key(Database& database, const RunRecord& record, WallTime now) {
  if (record.idempotency_key.empty()) return std::nullopt;
  auto query = database.cached(
      "SELECT i.hash,i.run FROM idempotency i JOIN run r ON r.id=i.run AND r.deleted=0 WHERE i.key=? AND i.created>?");
  query.all(record.idempotency_key, now - kKeyLife);
  if (!query.step()) return std::nullopt;
  if (query.text(0) != record.idempotency_hash) {
    throw LogError(LogError::Kind::conflict, "The idempotency key " + record.idempotency_key +
                                                 " was used in the last 24 hours with another request body.");
  }
  return query.integer(1);
}

void apply_update(Database& database, RunId run, const RunUpdate& u) {
  auto known = database.cached("SELECT 1 FROM run WHERE id=? AND deleted=0");
  if (!known.bind(1, run).step())
    throw LogError(LogError::Kind::missing, "There is no run " + std::to_string(run) + ".");
  const auto same = [](const auto& value) -> const auto& { return value; };
  const auto json = [](const auto& value) { return dump(Json(value)); };
  set_column(database, run, "UPDATE run SET state=? WHERE id=?", u.state, same);
  set_column(database, run, "UPDATE run SET started=? WHERE id=?", u.started, same);
  set_column(database, run, "UPDATE run SET ended=? WHERE id=?", u.ended, same);
  set_column(database, run, "UPDATE run SET error=? WHERE id=?", u.error, same);
  set_column(database, run, "UPDATE run SET tags=? WHERE id=?", u.tags, json);
  set_column(database, run, "UPDATE run SET note=? WHERE id=?", u.note, same);
  set_column(database, run, "UPDATE run SET pace=? WHERE id=?", u.pace, json);
  set_column(database, run, "UPDATE run SET dt=? WHERE id=?", u.dt, same);
  set_column(database, run, "UPDATE run SET steps=? WHERE id=?", u.steps, same);
  set_column(database, run, "UPDATE run SET reproducible=? WHERE id=?", u.reproducible, same);
  set_column(database, run, "UPDATE document SET body=? WHERE run=?", u.document, json);
  set_column(database, run, "UPDATE document SET design=? WHERE run=?", u.design, json);
  set_column(database, run, "UPDATE document SET designs=? WHERE run=?", u.designs, json);
  set_column(database, run, "UPDATE document SET world=? WHERE run=?", u.world, json);
  set_column(database, run, "UPDATE document SET warnings=? WHERE run=?", u.warnings, json);
  if (u.metrics) replace_metrics(database, run, *u.metrics);
  if (u.faults) replace_faults(database, run, *u.faults);
}

void insert_signals(Database& database, RunId run, const std::vector<Signal>& all, const std::vector<int>& logged,
                    std::int64_t every, LogPolicy policy, double dt) {
  database.cached("UPDATE run SET every=?,policy=?,dt=? WHERE id=?").all(every, to_string(policy), dt, run).run();
  std::vector<std::optional<std::int64_t>> slots(all.size());
  for (std::size_t slot = 0; slot < logged.size(); ++slot) {
    slots[static_cast<std::size_t>(logged[slot])] = static_cast<std::int64_t>(slot);
  }
  auto insert = database.cached(
      "INSERT OR REPLACE INTO signal(run,id,name,unit,kind,lane,node,link,labels,slot) VALUES(?,?,?,?,?,?,?,?,?,?)");
  for (const auto& s : all) {
    Json labels = Json::array();
    for (const auto& [value, word] : s.labels) labels.push_back({value, word});
    insert.all(run, s.id, s.name, s.unit, kind_name(s.kind), s.lane, s.node, s.link, dump(labels),
               slots[static_cast<std::size_t>(s.id)]);
    insert.run();
  }
}

void insert_mark(Database& database, RunId run, const Mark& m) {
  database.cached("INSERT INTO mark(run,k,type,edge,ref,lane,node,link,code,detail) VALUES(?,?,?,?,?,?,?,?,?,?)")
      .all(run, m.k, to_string(m.type), to_string(m.edge), m.id, m.lane, m.node, m.link, m.code, m.detail)
      .run();
}

void insert_command(Database& database, RunId run, const Command& command) {
  database.cached("INSERT INTO command(run,k,body) VALUES(?,?,?)").all(run, command.k, dump(command.body)).run();
}

void insert_gap(Database& database, RunId run, const GapRow& gap) {
  database.cached("INSERT OR REPLACE INTO gap(run,first,last) VALUES(?,?,?)").all(run, gap.from, gap.to).run();
  Mark mark;
  mark.k = gap.from;
  mark.type = MarkType::note;
  mark.code = "log_gap";
  mark.detail = "Samples of ticks " + std::to_string(gap.from) + " to " + std::to_string(gap.to) +
                " were not logged: the disk did not keep up.";
  insert_mark(database, run, mark);
}

void insert_block(Database& database, const SealedBlock& block, WallTime now) {
  database.cached("INSERT OR REPLACE INTO block(run,block,first,n,written) VALUES(?,?,?,?,?)")
      .all(block.run, block.block, block.first, block.n, now)
      .run();
  auto chunk = database.cached("INSERT OR REPLACE INTO chunk(run,block,sig,data) VALUES(?,?,?,?)");
  chunk.bind(1, block.run).bind(2, block.block);
  for (const auto& [signal, data] : block.chunks) chunk.bind(3, signal).blob(4, data).run();
  auto rollup =
      database.cached("INSERT OR REPLACE INTO rollup(run,sig,level,b,lo,hi,mean,n,nan) VALUES(?,?,?,?,?,?,?,?,?)");
  for (const auto& r : block.rollups) {
    const Summary& s = r.summary;
    rollup.all(block.run, r.signal, r.level, r.bucket, s.lo, s.hi, s.mean(), s.n, s.nan).run();
  }
  database.cached("DELETE FROM tail WHERE run=? AND k<=?").all(block.run, block.last_k).run();
}

void insert_tail(Database& database, const TailRow& row) {
  auto insert = database.cached("INSERT OR REPLACE INTO tail(run,k,v) VALUES(?,?,?)");
  const auto* bytes = reinterpret_cast<const char*>(row.v.data());
  insert.bind(1, row.run).bind(2, row.k).blob(3, std::string_view(bytes, row.v.size() * sizeof(double)));
  insert.run();
}

void set_newest(Database& database, RunId run, std::int64_t k) {
  database.cached("UPDATE run SET k=? WHERE id=?").all(k, run).run();
}

}  // namespace vigil
