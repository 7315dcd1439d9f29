/// The least a log of this kind can do: raw chunks of 512 doubles and their extremes through one SQLite connection,
/// WAL, FULL, a commit a block, SQLite's own checkpoints. No compression, checksum, queue, tail or other thread.
#pragma once

#include <sqlite3.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace vigil::bench {

class RawChunks {
 public:
  static constexpr int kRows = 512;

  RawChunks(const std::string& path, int signals)
      : signals_(signals), columns_(signals, std::vector<double>(kRows)), wide_(signals) {
    if (sqlite3_open(path.c_str(), &connection_) != SQLITE_OK) fail();
    execute("PRAGMA page_size=4096; PRAGMA journal_mode=WAL; PRAGMA synchronous=FULL; PRAGMA wal_autocheckpoint=1000");
    execute(
        "CREATE TABLE chunk(run INT, sig INT, step0 INT, n INT, lo REAL, hi REAL, mean REAL, data BLOB, PRIMARY "
        "KEY(run,sig,step0)) "
        "WITHOUT ROWID; CREATE TABLE roll(run INT, sig INT, level INT, b INT, lo REAL, hi REAL, mean REAL, "
        "PRIMARY KEY(run,sig,level,b)) WITHOUT ROWID");
    chunk_ = prepare("INSERT INTO chunk VALUES(1,?,?,?,?,?,?,?)");
    roll_ = prepare("INSERT INTO roll VALUES(1,?,?,?,?,?,?)");
  }
  ~RawChunks() {
    sqlite3_finalize(chunk_);
    sqlite3_finalize(roll_);
    sqlite3_close(connection_);
  }
  RawChunks(const RawChunks&) = delete;
  RawChunks& operator=(const RawChunks&) = delete;

  /// Ticks must come in order from 0, `values` one of each signal.
  void tick(std::int64_t k, const double* values) {
    const int row = static_cast<int>(k % kRows);
    for (int s = 0; s < signals_; ++s) columns_[s][row] = values[s];
    if (row == kRows - 1) seal(k - row);
  }

 private:
  struct Extremes {
    double lo = 1e300, hi = -1e300, sum = 0;
    int n = 0;
  };

  void seal(std::int64_t first) {
    execute("BEGIN");
    for (int s = 0; s < signals_; ++s) {
      const auto& column = columns_[s];
      Extremes e;
      for (const double value : column) {
        e.lo = std::min(e.lo, value);
        e.hi = std::max(e.hi, value);
        e.sum += value;
      }
      e.n = kRows;
      roll(s, 1, first / kRows, e);
      Extremes& w = wide_[s];
      w.lo = std::min(w.lo, e.lo);
      w.hi = std::max(w.hi, e.hi);
      w.sum += e.sum;
      w.n += e.n;
      if (first / kRows % 16 == 15) {
        roll(s, 2, first / kRows / 16, w);
        w = Extremes();
      }
      sqlite3_bind_int(chunk_, 1, s);
      sqlite3_bind_int64(chunk_, 2, first);
      sqlite3_bind_int(chunk_, 3, kRows);
      sqlite3_bind_double(chunk_, 4, e.lo);
      sqlite3_bind_double(chunk_, 5, e.hi);
      sqlite3_bind_double(chunk_, 6, e.sum / kRows);
      sqlite3_bind_blob(chunk_, 7, column.data(), kRows * static_cast<int>(sizeof(double)), SQLITE_STATIC);
      step(chunk_);
    }
    execute("COMMIT");
  }

  void roll(int signal, int level, std::int64_t bucket, const Extremes& e) {
    sqlite3_bind_int(roll_, 1, signal);
    sqlite3_bind_int(roll_, 2, level);
    sqlite3_bind_int64(roll_, 3, bucket);
    sqlite3_bind_double(roll_, 4, e.lo);
    sqlite3_bind_double(roll_, 5, e.hi);
    sqlite3_bind_double(roll_, 6, e.sum / e.n);
    step(roll_);
  }

  void step(sqlite3_stmt* statement) {
    if (sqlite3_step(statement) != SQLITE_DONE) fail();
    sqlite3_reset(statement);
  }
  void execute(const char* sql) {
    if (sqlite3_exec(connection_, sql, nullptr, nullptr, nullptr) != SQLITE_OK) fail();
  }
  sqlite3_stmt* prepare(const char* sql) {
    sqlite3_stmt* statement = nullptr;
    if (sqlite3_prepare_v2(connection_, sql, -1, &statement, nullptr) != SQLITE_OK) fail();
    return statement;
  }
  [[noreturn]] void fail() {
    std::fprintf(stderr, "raw chunks: %s\n", sqlite3_errmsg(connection_));
    std::exit(1);
  }

  const int signals_;
  sqlite3* connection_ = nullptr;
  sqlite3_stmt* chunk_ = nullptr;
  sqlite3_stmt* roll_ = nullptr;
  std::vector<std::vector<double>> columns_;
  std::vector<Extremes> wide_;
};

}  // namespace vigil::bench
