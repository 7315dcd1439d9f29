#include "server/ingest/seq_memory.hpp"

namespace vigil {

bool SeqMemory::known(int source, std::uint64_t seq) const {
  const auto place = seqs_.find(source);
  return place != seqs_.end() && place->second.known.contains(seq);
}

void SeqMemory::remember(int source, std::uint64_t seq) {
  Seqs& seqs = seqs_[source];
  if (!seqs.known.insert(seq).second) return;
  seqs.order.push_back(seq);
  if (seqs.order.size() <= most_) return;
  seqs.known.erase(seqs.order.front());
  seqs.order.pop_front();
}

}  // namespace vigil
