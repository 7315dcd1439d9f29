/// The newest sequence numbers of each source.
#pragma once

#include <cstdint>
#include <deque>
#include <set>
#include <unordered_map>

namespace vigil {

class SeqMemory {
 public:
  explicit SeqMemory(std::size_t most) : most_(most) {}
  bool known(int source, std::uint64_t seq) const;
  /// Forgets the source's oldest where there are more than `most`.
  void remember(int source, std::uint64_t seq);

 private:
  struct Seqs {
    std::set<std::uint64_t> known;
    std::deque<std::uint64_t> order;
  };
  const std::size_t most_;
  std::unordered_map<int, Seqs> seqs_;
};

}  // namespace vigil
