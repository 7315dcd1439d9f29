/// Where a run's thread leaves its frames for the writer: a few copies under a lock that is never held for long.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <limits>
#include <mutex>
#include <vector>

#include "db/records.hpp"
#include "db/writer.hpp"

namespace vigil {

/// Consecutive rows: of each its tick, then t and the selected values.
struct RowBatch {
  std::vector<std::int64_t> k;
  std::vector<double> cells;  ///< k.size() rows of width + 1
};

class Intake {
 public:
  /// `signals` 0 … n-1 in order mean the whole frame. `budget` is in bytes.
  Intake(LogSelection selection, LogPolicy policy, std::size_t budget);

  /// Takes a frame in, waits for room (lossless), or drops it (live). True: enough has gathered to wake the writer.
  bool push(const Frame& frame);
  void set_policy(LogPolicy policy);
  /// Frames that come later are ignored; whoever waits for room goes on.
  void close();

  struct Taken {
    std::vector<RowBatch> rows;
    std::vector<GapRow> gaps;
    std::size_t bytes = 0;  ///< to give back with release()
    bool left = false;      ///< more than a batch stayed behind
  };
  /// What has gathered, oldest first, up to about `most` bytes. After close() an open gap comes along.
  Taken take(std::size_t most);
  /// The bytes are on the disk: there is room again. The emptied batches are used again.
  void release(std::size_t bytes, std::vector<RowBatch> used);

  std::size_t queued_bytes() const;
  std::int64_t dropped() const;
  std::int64_t every() const { return selection_.every; }
  const std::vector<int>& signals() const { return selection_.signals; }

 private:
  void drop(std::int64_t k);
  void append(const Frame& frame);
  RowBatch& open_batch();

  const LogSelection selection_;
  const std::size_t row_bytes_;
  const std::size_t batch_rows_;
  const std::size_t budget_;
  bool whole_ = true;  ///< the selection is 0, 1, 2, …
  mutable std::mutex mutex_;
  std::condition_variable room_;
  LogPolicy policy_;
  bool closed_ = false;
  bool dropping_ = false;
  GapRow gap_;
  std::vector<RowBatch> full_;
  std::vector<RowBatch> spare_;
  std::vector<GapRow> gaps_;
  std::size_t bytes_ = 0;   ///< taken in and not yet released
  std::size_t queued_ = 0;  ///< of those, not yet taken
  std::int64_t newest_ = std::numeric_limits<std::int64_t>::min();
  std::int64_t dropped_ = 0;
};

}  // namespace vigil
