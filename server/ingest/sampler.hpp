/// Values that come without a tick, sampled at their time of arrival. No clock of its own, no thread, no lock.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "server/ingest/assembler.hpp"
#include "server/ingest/seq_memory.hpp"

namespace vigil {

struct SamplerLimits {
  double dt = 1;                     ///< s, of a tick
  double hold = 0;                   ///< s that a value stands for the ticks after its own
  std::size_t room = 1000;           ///< closed ticks at once
  std::size_t seqs = 1024;           ///< newest sequence numbers remembered of each source
  std::optional<std::int64_t> last;  ///< tick after which the run takes nothing
};

/// Tick 0 begins with the first value, tick k lasts from k dt to (k + 1) dt after it. A tick has the newest value of
/// each column that came in it, or one that is held; all others are missing.
class Sampler {
 public:
  /// `columns` outlives it.
  Sampler(const PushedColumns& columns, SamplerLimits limits);

  /// False where the ticks before `now` do not fit into the room: nothing more can be taken.
  bool advance(double now);
  /// The rows' ticks are not looked at. `now` in s on a clock that never goes back; advance(now) was true.
  Tally take(const std::vector<IngestRow>& rows, double now);
  /// When the tick that goes on ends; empty before the first value and after the last tick.
  std::optional<double> due() const;

  std::int64_t closed() const { return closed_; }
  std::vector<std::int64_t> open() const;
  std::size_t ready() const { return ready_.size(); }
  std::vector<double> pop();

 private:
  bool over() const { return limits_.last && closed_ >= *limits_.last; }
  void close();

  const PushedColumns& columns_;
  const SamplerLimits limits_;
  std::vector<double> value_, since_;  ///< by column: the newest, and when it came
  std::deque<std::vector<double>> ready_;
  SeqMemory seqs_;
  std::optional<double> start_;
  std::int64_t closed_ = -1;
};

}  // namespace vigil
