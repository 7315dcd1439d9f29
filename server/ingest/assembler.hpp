/// Puts rows that come in any order together into ticks. No clock of its own, no thread, no lock.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "server/ingest/read_rows.hpp"
#include "server/ingest/seq_memory.hpp"

namespace vigil {

struct AssemblerLimits {
  double deadline = 1;               ///< s a tick waits for what is missing, from the first row of it or of a later one
  std::size_t open = 64;             ///< ticks at once; the next one closes the earliest
  std::int64_t ahead = 1000;         ///< a row may skip so many ticks, and no more
  std::int64_t advance = 10'000;     ///< the rows of one call may go on by so many
  std::size_t seqs = 1024;           ///< newest sequence numbers remembered of each source
  std::optional<std::int64_t> last;  ///< tick after which the run takes nothing
};

/// What became of rows.
struct Tally {
  std::int64_t accepted = 0;
  std::int64_t duplicate = 0;  ///< the source's seq was there, or all that it reports of its tick
  std::int64_t late = 0;       ///< the tick was closed
  std::int64_t beyond = 0;     ///< the run ends before the tick
};

class Assembler {
 public:
  /// `columns` outlives it.
  Assembler(const PushedColumns& columns, AssemblerLimits limits);

  /// `now` in s on a clock that never goes back. Throws InputError, with nothing done, where a row lies further ahead
  /// than it may.
  Tally take(const std::vector<IngestRow>& rows, double now);
  /// Closes every tick whose deadline has passed.
  void expire(double now);
  /// When expire() has work; empty: not before the next row.
  std::optional<double> due() const;

  std::int64_t closed() const { return closed_; }      ///< newest closed tick, -1: none
  std::vector<std::int64_t> open() const;              ///< ticks that have rows and wait for more
  std::size_t ready() const { return ready_.size(); }  ///< closed ticks not yet taken out
  /// The cells of the earliest closed tick, NaN where missing. ready() must not be 0.
  std::vector<double> pop();

 private:
  struct OpenTick {
    std::vector<double> cells;
    std::vector<char> reported;  ///< by node, then nobody in particular
    std::vector<char> seen;      ///< by column, of partial rows
    std::vector<int> left;       ///< by group: columns that its partial rows have not brought
    std::size_t missing = 0;     ///< reports that are waited for
    double since = 0;            ///< s
    bool touched = false;
  };
  void check_ahead(const std::vector<IngestRow>& rows) const;
  OpenTick& reach(std::int64_t k, double now);
  void take(const IngestRow& row, double now, Tally& tally);
  bool apply(const IngestRow& row, OpenTick& tick);
  bool apply_partial(const IngestRow& row, OpenTick& tick);
  void report(OpenTick& tick, std::size_t group) const;
  void close_front();
  void close_complete();
  std::size_t group(int column) const;

  const PushedColumns& columns_;
  const AssemblerLimits limits_;
  std::vector<char> awaited_;    ///< by group: a tick waits for it
  std::vector<int> parts_;       ///< by group: columns that its partial rows bring
  std::deque<OpenTick> window_;  ///< of tick closed_ + 1 and on
  std::deque<std::vector<double>> ready_;
  SeqMemory seqs_;
  std::int64_t closed_ = -1;
};

}  // namespace vigil
