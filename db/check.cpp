#include "db/check.hpp"

#include <cmath>
#include <limits>

#include "db/chunk.hpp"
#include "db/rollup.hpp"
#include "db/schema.hpp"
#include "engine/core/missing.hpp"

namespace vigil {

namespace {

constexpr std::size_t kMostSentences = 50;

bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

class Checker {
 public:
  explicit Checker(Database& database) : database_(database) {}

  MaintenanceReport check() {
    integrity();
    orphans();
    auto runs = database_.cached("SELECT id,every FROM run WHERE deleted=0 ORDER BY id");
    while (runs.step()) {
      ++report_.runs;
      check_run(runs.integer(0), runs.integer(1));
    }
    if (report_.ok) {
      report_.sentences.push_back("The log is sound: " + std::to_string(report_.runs) + " runs, " +
                                  std::to_string(report_.blocks) + " blocks, " + std::to_string(report_.chunks) +
                                  " chunks.");
    }
    return report_;
  }

 private:
  void trouble(const std::string& sentence) {
    report_.ok = false;
    if (report_.sentences.size() < kMostSentences) report_.sentences.push_back(sentence);
  }

  void integrity() {
    auto pages = database_.statement("PRAGMA integrity_check(20)");
    while (pages.step()) {
      if (pages.text(0) != "ok") trouble("SQLite: " + pages.text(0) + ".");
    }
    auto keys = database_.statement("PRAGMA foreign_key_check");
    while (keys.step())
      trouble("A row of table " + keys.text(0) + " refers to a row of " + keys.text(2) + " that is not there.");
  }

  void orphans() {
    for (const char* table : {"block", "chunk", "rollup", "tail"}) {
      const std::string name = table;
      auto query = database_.statement("SELECT run FROM (SELECT DISTINCT run FROM " + name +
                                       ") WHERE run NOT IN (SELECT id FROM run)");
      while (query.step()) trouble("Table " + name + " has rows of run " + query.text(0) + ", which is not there.");
    }
  }

  void check_run(RunId run, std::int64_t every) {
    name_ = "Run " + std::to_string(run);
    next_ = std::numeric_limits<std::int64_t>::min();
    read_gaps(run, every);
    auto logged = database_.cached("SELECT count(*) FROM signal WHERE run=? AND slot IS NOT NULL");
    const std::int64_t width = logged.bind(1, run).step() ? logged.integer(0) : 0;
    auto blocks = database_.cached("SELECT block,first,n FROM block WHERE run=? ORDER BY block");
    blocks.bind(1, run);
    while (blocks.step()) {
      ++report_.blocks;
      check_block(run, blocks.integer(0), blocks.integer(1), blocks.integer(2), width);
    }
    auto orphan = database_.cached(
        "SELECT count(*) FROM (SELECT DISTINCT block FROM chunk WHERE run=?1) WHERE block NOT IN (SELECT block FROM "
        "block WHERE "
        "run=?1)");
    if (orphan.bind(1, run).step() && orphan.integer(0) > 0) trouble(name_ + " has chunks that belong to no block.");
    auto tail = database_.cached("SELECT k,length(v) FROM tail WHERE run=? ORDER BY k");
    tail.bind(1, run);
    while (tail.step()) {
      if (tail.integer(1) != (width + 1) * 8)
        trouble(name_ + ": the tail's tick " + tail.text(0) + " has the wrong size.");
      if (tail.integer(0) % every != 0)
        trouble(name_ + ": the tail's tick " + tail.text(0) + " is none that is logged.");
      row(tail.integer(0) / every);
    }
  }

  void read_gaps(RunId run, std::int64_t every) {
    gaps_.clear();
    auto query = database_.cached("SELECT first,last FROM gap WHERE run=? ORDER BY first");
    query.bind(1, run);
    while (query.step()) gaps_.push_back({query.integer(0) / every, query.integer(1) / every});
  }

  bool in_gap(std::int64_t row) const {
    for (const auto& gap : gaps_) {
      if (row >= gap.from && row <= gap.to) return true;
    }
    return false;
  }

  /// Rows must follow one another; what is missing must be a gap.
  void row(std::int64_t at) {
    if (next_ != std::numeric_limits<std::int64_t>::min() && at != next_) {
      if (at < next_) {
        trouble(name_ + ": row " + std::to_string(at) + " is there twice.");
      } else if (!in_gap(next_) || !in_gap(at - 1)) {
        trouble(name_ + ": rows " + std::to_string(next_) + " to " + std::to_string(at - 1) +
                " are missing and no gap says so.");
      }
    }
    next_ = at + 1;
  }

  void check_block(RunId run, std::int64_t block, std::int64_t first, std::int64_t n, std::int64_t width) {
    if (n < 1 || n > kBlockRows || first / kBlockRows != block || (first + n - 1) / kBlockRows != block) {
      trouble(name_ + ": block " + std::to_string(block) + " has impossible bounds.");
      return;
    }
    std::vector<double> values(static_cast<std::size_t>(n)), times(values.size(), 0.0);
    std::int64_t chunks = 0;
    auto query = database_.cached("SELECT sig,data FROM chunk WHERE run=? AND block=? ORDER BY sig");
    query.all(run, block);
    while (query.step()) {
      const int signal = static_cast<int>(query.integer(0));
      try {
        decode_chunk(query.bytes(1), values);
      } catch (const ChunkError& error) {
        trouble(name_ + ", block " + std::to_string(block) + ", signal " + std::to_string(signal) + ": " +
                error.what() + ".");
      }
      ++report_.chunks;
      if (signal == kTimeSignal) {
        times = values;
      } else {
        ++chunks;
        check_rollup(run, block, signal, values);
      }
    }
    if (chunks != width) {
      trouble(name_ + ": block " + std::to_string(block) + " has " + std::to_string(chunks) + " chunks for " +
              std::to_string(width) + " signals.");
    }
    for (std::int64_t i = 0; i < n; ++i) {
      if (!std::isnan(times[static_cast<std::size_t>(i)])) row(first + i);
    }
  }

  void check_rollup(RunId run, std::int64_t block, int signal, const std::vector<double>& values) {
    Summary summary;
    for (const double value : values) summary.add(value);
    auto query = database_.cached("SELECT lo,hi,n FROM rollup WHERE run=? AND sig=? AND level=0 AND b=?");
    const bool there = query.all(run, signal, block).step();
    if (there && same(query.real(0), summary.lo) && same(query.real(1), summary.hi) && query.integer(2) == summary.n)
      return;
    trouble(name_ + ": the rollup of block " + std::to_string(block) + ", signal " + std::to_string(signal) +
            " does not agree with its chunk.");
  }

  Database& database_;
  MaintenanceReport report_;
  std::string name_;
  std::vector<GapRow> gaps_;
  std::int64_t next_ = 0;
};

}  // namespace

MaintenanceReport check_database(Database& database) {
  Transaction transaction(database, "BEGIN");
  return Checker(database).check();
}

}  // namespace vigil
