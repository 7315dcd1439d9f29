/// Who sees or moves which modes of a plant, as members of the report on a system.
#pragma once

#include <optional>
#include <string>

#include "engine/core/json.hpp"
#include "engine/linalg/modes.hpp"

namespace vigil {

/// How the report says what was tested.
inline constexpr const char* kVisibilityTolerance =
    "A mode counts as hidden where the least singular value of [A - mode I; C] is at most 1e-10 (Popov, Belevitch and "
    "Hautus), A divided by its Frobenius norm and every row of C by its length; it counts as lasting where its modulus "
    "is not below 1 by more than 1e-8, in continuous time its real part not below 0 by more than 1e-8 of that norm.";

/// [{"re","im","size","behaviour","count","text"}]
Json modes_json(const std::vector<Mode>& modes, const Modes& all, TimeKind time);

/// What the outcome of one test is called.
struct Question {
  std::string who;       ///< "node 2"
  const char* sees;      ///< "sees", "see", "moves"
  const char* sees_not;  ///< "does not see", …
  std::string then;      ///< what follows where a mode that does not decay is hidden
};

/// Tests against one A. Where A is not finite nothing is tested: every member is null, and the verdict says why.
class ModeJudge {
 public:
  ModeJudge(const Eigen::MatrixXd& A, TimeKind time);

  const std::optional<Modes>& modes() const { return modes_; }  ///< nothing: not tested
  const std::string& untested() const { return untested_; }     ///< why not

  /// {"rank","observable","detectable","hidden","weakest","verdict"}; C: p x n
  Json observes(const Question& question, const Eigen::MatrixXd& C) const;
  /// The same with "controllable" and "stabilisable"; B: n x m
  Json moves(const Question& question, const Eigen::MatrixXd& B) const;

 private:
  Json answer(const Question& question, const Eigen::MatrixXd& A, const Eigen::MatrixXd& C, const char* whole,
              const char* lasting) const;

  Eigen::MatrixXd A_;
  TimeKind time_;
  std::optional<Modes> modes_;
  std::string untested_;
};

}  // namespace vigil
