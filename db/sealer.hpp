/// From rows to sealed blocks: pure work of the writer's thread, no SQL.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "db/intake.hpp"
#include "db/rollup.hpp"

namespace vigil {

/// kBlockRows rows (fewer at the ends of a run) of every logged signal, ready to be stored.
struct SealedBlock {
  RunId run = 0;
  std::int64_t block = 0;  ///< row / kBlockRows
  std::int64_t first = 0;  ///< row of the first value; row = k / every
  int n = 0;               ///< rows from the first to the last value, dropped ones included
  std::int64_t last_k = 0;
  std::vector<std::pair<int, std::string>> chunks;  ///< signal (kTimeSignal: t) and bytes
  std::vector<RollupRow> rollups;
};

struct TailRow {
  RunId run = 0;
  std::int64_t k = 0;
  std::vector<double> v;  ///< t, then the logged signals in order
};

class Sealer {
 public:
  Sealer(RunId run, std::vector<int> signals, std::int64_t every, double dt);
  /// Blocks that are complete go to `sealed`.
  void add(const RowBatch& rows, std::vector<SealedBlock>& sealed);
  /// Seals what is open.
  void seal(std::vector<SealedBlock>& sealed);
  /// Rows added since the last call that are not sealed.
  void save_tail(std::vector<TailRow>& tail);
  std::int64_t newest() const { return newest_; }

 private:
  void add_row(std::int64_t k, const double* cells, std::vector<SealedBlock>& sealed);
  bool regular_time(std::int64_t begin, std::int64_t end) const;
  void roll(std::size_t slot, const Summary& summary, SealedBlock& block);
  void emit(int level, SealedBlock& block);

  const RunId run_;
  const std::vector<int> signals_;
  const std::int64_t every_;
  const double dt_;
  std::vector<double> cells_;  ///< column-major: t and each signal, kBlockRows each; NaN where no row came
  std::int64_t block_ = -1;
  int begin_ = 0, end_ = 0;  ///< rows of the open block that are in use
  int saved_ = 0;            ///< rows below this are in the tail
  std::int64_t newest_ = -1;
  std::array<std::int64_t, 2> bucket_ = {-1, -1};  ///< open bucket of levels 1 and 2
  std::array<std::vector<Summary>, 2> coarse_;     ///< of each signal
};

}  // namespace vigil
