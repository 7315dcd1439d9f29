/// One design problem and what has become of it. Free of matrices, for those who only pass it on.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "engine/core/json.hpp"

namespace vigil {

struct DesignerOptions {
  std::string executable;         ///< whose `solve-sdp` is started; empty: the one that runs now
  double limit = 120;             ///< s a solve may take
  std::size_t max_waiting = 64;   ///< problems that wait for their turn
  std::size_t max_settled = 256;  ///< answers kept in memory; those that stay true are in the log, too
};

struct DesignItem {
  enum class State { queued, solving, done, refused };
  std::string lane;  ///< that asked for it
  std::string key;
  State state = State::queued;
  double seconds = 0;  ///< of solving, up to now
  double limit = 0;    ///< s
  Json record;         ///< null until there is one
  std::string reason;  ///< where refused: one sentence
  bool settled() const { return state == State::done || state == State::refused; }
};

std::string_view to_string(DesignItem::State state);
/// {"lane","key","state","seconds","limit","record","reason"}; reason null unless refused.
Json to_json(const DesignItem& item);

/// With a record, which may be null: done where it holds, refused otherwise.
DesignItem settle(DesignItem item, Json record);
/// Whether the same problem may have another answer tomorrow: its solve timed out, crashed or was never made.
bool may_be_tried_again(const DesignItem& item);

}  // namespace vigil
