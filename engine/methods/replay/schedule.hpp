/// The mixed estimator's gains and error sets, which depend on no reading. Made once, shared by all copies of a lane.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "engine/methods/replay/mixed_update.hpp"
#include "engine/methods/replay/system.hpp"

namespace vigil::replay {

class Schedule {
 public:
  /// Steps after the batch, until nothing changes any more (bit for bit) or `most` are made. Nothing where an
  /// innovation matrix cannot be inverted.
  static std::shared_ptr<const Schedule> make(const System& system, const MixedUpdate& update, const Bounds& start,
                                              int most = 4096);
  /// Step 1 is the first after the batch; beyond the last one they are all the same. Null where most were made and the
  /// gains still change: they must be computed on line.
  const GainChoice* step(std::int64_t step) const;
  const GainChoice& last() const { return steps_.back(); }

 private:
  std::vector<GainChoice> steps_;
  bool settled_ = false;
};

}  // namespace vigil::replay
