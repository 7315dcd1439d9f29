/// What cannot be asked of a run at this moment.
#pragma once

#include <stdexcept>
#include <string>

namespace vigil {

class RunRefusal : public std::runtime_error {
 public:
  enum class Kind {
    state,  ///< the run is in a state that does not allow it
    busy,   ///< the run's thread did not answer in time; the request may be repeated
    full,   ///< too many runs wait already
    behind  ///< more was pushed into the run than it has worked off
  };
  RunRefusal(Kind kind, const std::string& sentence) : std::runtime_error(sentence), kind_(kind) {}
  Kind kind() const { return kind_; }

 private:
  Kind kind_;
};

}  // namespace vigil
