/// One design problem and what has become of it.
#pragma once

#include <string>
#include <string_view>

#include "engine/core/json.hpp"

namespace vigil {

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
