#include "server/crew/job.hpp"

#include <algorithm>
#include <stdexcept>

#include "engine/core/bytes.hpp"
#include "server/crew/pack.hpp"

namespace vigil {
namespace {

constexpr std::uint64_t kJob = 0x3130'424f'4a47'4956;     // "VIGJOB01"
constexpr std::uint64_t kPiece = 0x3130'4345'4950'4756;   // "VGPIEC01"
constexpr std::size_t kMostBytes = std::size_t{1} << 31;  // of one job's results
constexpr std::size_t kMostPieces = 1 << 16;
constexpr std::size_t kHead = 9 * 8;  // of a piece: what put() reads before the bytes themselves

void put(ByteWriter& out, const TrialJob& job) {
  out.integer(job.first);
  out.integer(job.count);
  out.integer(job.attempt);
}

TrialJob job_of(ByteReader& in) {
  TrialJob job;
  job.first = in.integer();
  job.count = in.integer();
  job.attempt = in.integer();
  const bool sane = job.first >= 0 && job.count >= 1 && job.count <= 1'000'000 && job.first <= 1'000'000'000;
  if (!sane) throw std::runtime_error("A job asks for trials that cannot be.");
  return job;
}

std::string body_of(const JobResult& result) {
  ByteWriter out;
  out.number(result.seconds);
  out.text(result.error);
  out.word(result.trials.size());
  for (const std::string& trial : result.trials) out.text(trial);
  return out.take();
}

JobResult result_of(const TrialJob& job, std::string_view body) {
  ByteReader in(body);
  JobResult result;
  result.job = job;
  result.seconds = in.number();
  result.error = in.text();
  for (std::size_t left = in.count(8); left > 0; --left) result.trials.push_back(in.text());
  const bool whole =
      result.error.empty() ? result.trials.size() == static_cast<std::size_t>(job.count) : result.trials.empty();
  if (!in.done() || !whole) throw std::runtime_error("A job's results are not those of its trials.");
  return result;
}

}  // namespace

std::string to_bytes(const TrialJob& job) {
  ByteWriter out;
  out.word(kJob);
  put(out, job);
  return out.take();
}

TrialJob job_from_bytes(std::string_view bytes) {
  ByteReader in(bytes);
  if (in.word() != kJob) throw std::runtime_error("These bytes are no job.");
  const TrialJob job = job_of(in);
  if (!in.done()) throw std::runtime_error("A job has something left over.");
  return job;
}

std::vector<std::string> pieces_of(const JobResult& result, std::uint64_t nonce, std::size_t most) {
  const std::string packed = pack(body_of(result));
  const std::size_t room = std::max<std::size_t>(most, 1024) - kHead;
  const std::size_t parts = std::max<std::size_t>(1, (packed.size() + room - 1) / room);
  std::vector<std::string> pieces;
  for (std::size_t part = 0; part < parts; ++part) {
    ByteWriter out;
    out.word(kPiece);
    put(out, result.job);
    out.word(nonce);
    out.word(part);
    out.word(parts);
    out.text(std::string_view(packed).substr(part * room, room));
    pieces.push_back(out.take());
  }
  return pieces;
}

JobAssembler::Parts& JobAssembler::parts_of(std::uint64_t nonce, const TrialJob& job, std::size_t parts) {
  for (Parts& open : open_) {
    if (open.nonce == nonce && open.job == job && open.parts.size() == parts) return open;
  }
  return open_.emplace_back(Parts{nonce, job, std::vector<std::string>(parts), parts});
}

bool JobAssembler::put(std::string_view piece, JobResult& result) {
  ByteReader in(piece);
  if (in.word() != kPiece) throw std::runtime_error("These bytes are no piece of a job's results.");
  const TrialJob job = job_of(in);
  const std::uint64_t nonce = in.word(), part = in.word(), parts = in.word();
  if (parts < 1 || parts > kMostPieces || part >= parts) throw std::runtime_error("A piece has an impossible number.");
  std::string bytes = in.text();
  if (!in.done() || bytes.empty()) throw std::runtime_error("A piece is damaged.");
  Parts& open = parts_of(nonce, job, parts);
  std::string& place = open.parts[part];
  if (place.empty()) --open.missing;
  place = std::move(bytes);
  if (open.missing > 0) return false;
  std::string packed;
  for (const std::string& one : open.parts) packed += one;
  open_.erase(open_.begin() + (&open - open_.data()));
  result = result_of(job, unpack(packed, kMostBytes));
  return true;
}

void JobAssembler::forget_before(std::int64_t first) {
  std::erase_if(open_, [&](const Parts& open) { return open.job.first + open.job.count <= first; });
}

}  // namespace vigil
