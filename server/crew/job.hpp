/// What goes to a worker and what comes back: a range of a campaign's trials, and their results as bytes.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace vigil {

/// Trials first .. first + count - 1. attempt: how often the campaign has published the range, from 1.
struct TrialJob {
  std::int64_t first = 0, count = 0, attempt = 1;
  bool operator==(const TrialJob&) const = default;
};

std::string to_bytes(const TrialJob& job);
/// Throws std::runtime_error where the bytes are none.
TrialJob job_from_bytes(std::string_view bytes);

/// What a worker made of a job. It travels in pieces that a broker takes.
struct JobResult {
  TrialJob job;
  double seconds = 0;               ///< that the trials took, one after the other
  std::string error;                ///< thrown by a trial and not its own failure; then there are no trials
  std::vector<std::string> trials;  ///< save_trial() of each
};

/// Pieces of at most `most` bytes each (at least 1 kB), of which none says anything without the others. nonce: tells
/// the pieces of this making from those of another.
std::vector<std::string> pieces_of(const JobResult& result, std::uint64_t nonce, std::size_t most);

/// Puts pieces together, in whatever order they come.
class JobAssembler {
 public:
  /// True with `result` filled by the last missing piece. Throws std::runtime_error where it is no piece, or what came
  /// together is damaged (it is forgotten then).
  bool put(std::string_view piece, JobResult& result);
  /// Forgets pieces of jobs that end before trial `first`.
  void forget_before(std::int64_t first);

 private:
  struct Parts {
    std::uint64_t nonce = 0;
    TrialJob job;
    std::vector<std::string> parts;
    std::size_t missing = 0;
  };
  Parts& parts_of(std::uint64_t nonce, const TrialJob& job, std::size_t parts);

  std::vector<Parts> open_;
};

}  // namespace vigil
