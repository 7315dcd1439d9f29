/// LogWriter's calls on scenarios, traces and settings.
#include "db/chunk.hpp"
#include "db/writer_state.hpp"

namespace vigil {

namespace {
constexpr int kDesignsKept = 500;
}

void LogWriter::put_scenario(const std::string& id, const Json& document) {
  const WallTime now = state_->now();
  state_->commit_now([&](Database& database) {
    database
        .cached(
            "INSERT INTO scenario(id,document,created,updated) VALUES(?1,?2,?3,?3) "
            "ON CONFLICT(id) DO UPDATE SET document=?2,updated=?3")
        .all(id, dump(document), now)
        .run();
  });
}

bool LogWriter::delete_scenario(const std::string& id) {
  bool there = false;
  state_->commit_now([&](Database& database) {
    database.cached("DELETE FROM scenario WHERE id=?").bind(1, id).run();
    there = database.changes() > 0;
  });
  return there;
}

std::int64_t LogWriter::put_trace(const std::string& name, std::string_view csv, std::int64_t rows,
                                  const std::vector<std::string>& columns) {
  const std::string hash = sha256_hex(csv), packed = compress_text(csv);
  const WallTime now = state_->now();
  std::int64_t id = 0;
  state_->commit_now([&](Database& database) {
    auto known = database.cached("SELECT id FROM trace WHERE hash=?");
    if (known.bind(1, hash).step()) {
      id = known.integer(0);
      return;
    }
    auto insert = database.cached("INSERT INTO trace(name,hash,rows,columns,bytes,created,csv) VALUES(?,?,?,?,?,?,?)");
    insert.all(name, hash, rows, dump(Json(columns)), static_cast<std::int64_t>(csv.size()), now).blob(7, packed).run();
    id = database.last_id();
  });
  return id;
}

bool LogWriter::delete_trace(std::int64_t id) {
  bool there = false;
  state_->commit_now([&](Database& database) {
    database.cached("DELETE FROM trace WHERE id=?").bind(1, id).run();
    there = database.changes() > 0;
  });
  return there;
}

void LogWriter::set_setting(const std::string& key, const Json& value) {
  state_->commit_now([&](Database& database) {
    database.cached("INSERT OR REPLACE INTO setting(key,value) VALUES(?,?)").all(key, dump(value)).run();
  });
}

void LogWriter::put_design(const std::string& key, const std::string& lane, const Json& record,
                           std::string_view problem) {
  const std::string packed = compress_text(problem);
  const WallTime now = state_->now();
  state_->commit_now([&](Database& database) {
    auto insert = database.cached("INSERT OR REPLACE INTO design(key,lane,record,created,problem) VALUES(?,?,?,?,?)");
    insert.all(key, lane, dump(record), now).blob(5, packed).run();
    database.cached("DELETE FROM design WHERE key NOT IN(SELECT key FROM design ORDER BY created DESC LIMIT ?)")
        .bind(1, kDesignsKept)
        .run();
  });
}

}  // namespace vigil
