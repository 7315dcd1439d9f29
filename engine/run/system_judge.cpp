#include "engine/run/system_judge.hpp"

#include <fmt/format.h>

#include "engine/run/system_words.hpp"

namespace vigil {
namespace {

using Eigen::MatrixXd;

Json mode_json(const Mode& mode, const Modes& all, TimeKind time) {
  return {{"re", mode.value.real()},     {"im", mode.value.imag()},
          {"size", size_of(mode, time)}, {"behaviour", to_string(all.fate(mode))},
          {"count", mode.count},         {"text", mode_text(mode)}};
}

}  // namespace

Json modes_json(const std::vector<Mode>& modes, const Modes& all, TimeKind time) {
  Json list = Json::array();
  for (const Mode& mode : modes) list.push_back(mode_json(mode, all, time));
  return list;
}

ModeJudge::ModeJudge(const MatrixXd& A, TimeKind time) : A_(A), time_(time), modes_(Modes::of(A, time)) {
  if (!modes_) untested_ = "the plant's derivative is not finite at the initial truth, so nothing was tested";
}

/// A test of C, or of the transpose of B, with its answer in words; null answers where nothing was tested.
Json ModeJudge::answer(const Question& question, const MatrixXd& A, const MatrixXd& C, const char* whole,
                       const char* lasting) const {
  Json part{{"rank", nullptr},   {whole, nullptr},     {lasting, nullptr},
            {"hidden", nullptr}, {"weakest", nullptr}, {"verdict", untested_}};
  if (!modes_) return part;
  const auto seen = visibility(A, C, time_);
  if (!seen) {
    part["verdict"] = question.who + " cannot be judged: its derivative is not finite at the initial truth";
    return part;
  }
  const bool harmless = all_decay(seen->hidden, *modes_);
  part["rank"] = seen->rank;
  part[whole] = seen->hidden.empty();
  part[lasting] = harmless;
  part["hidden"] = modes_json(seen->hidden, *modes_, time_);
  part["weakest"] = {{"mode", mode_text(seen->weakest)}, {"value", seen->margin}};
  if (seen->hidden.empty())
    part["verdict"] = fmt::format("{} {} every mode of the plant", question.who, question.sees);
  else
    part["verdict"] = fmt::format("{} {} {}{}", question.who, question.sees_not, modes_text(seen->hidden, *modes_),
                                  harmless ? ": what is missed dies out by itself" : question.then);
  return part;
}

Json ModeJudge::observes(const Question& question, const MatrixXd& C) const {
  return answer(question, A_, C, "observable", "detectable");
}

Json ModeJudge::moves(const Question& question, const MatrixXd& B) const {
  return answer(question, A_.transpose(), B.transpose(), "controllable", "stabilisable");
}

}  // namespace vigil
