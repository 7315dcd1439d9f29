#include "engine/run/fault_table.hpp"

#include <string_view>

namespace vigil {

FaultTable::Entry& FaultTable::find(int node, const char* code, bool& fresh) {
  fresh = false;
  for (Entry& entry : entries_) {
    if (entry.node == node && std::string_view(entry.code) == code) return entry;
  }
  fresh = true;
  entries_.push_back({node, code, k_, k_ - 1, 0, false, false, {}});
  return entries_.back();
}

std::string* FaultTable::fault(int node, const char* code) {
  bool fresh = false;
  Entry& entry = find(node, code, fresh);
  if (entry.last != k_) ++entry.count;
  entry.last = k_;
  return fresh ? &entry.detail : nullptr;
}

std::string* FaultTable::stop(int node, const char* code) {
  stopped_ = true;
  bool fresh = false;
  Entry& entry = find(node, code, fresh);
  ++entry.count;
  entry.last = k_;
  entry.stopped = true;
  return &entry.detail;
}

void FaultTable::mark_edges(const std::string& lane, const std::vector<std::string>& outputs, Sink& sink) {
  for (Entry& entry : entries_) {
    const bool now = entry.last == k_;
    if (now == entry.open) continue;
    entry.open = now;
    Mark mark;
    mark.k = k_;
    mark.type = MarkType::fault;
    mark.edge = now ? MarkEdge::begin : MarkEdge::end;
    mark.lane = lane;
    if (entry.node >= 0) mark.node = outputs[static_cast<std::size_t>(entry.node)];
    mark.code = entry.code;
    if (now && entry.count == 1) mark.detail = entry.detail;
    sink.mark(mark);
  }
}

void FaultTable::append(const std::string& lane, const std::vector<std::string>& outputs,
                        std::vector<FaultCount>& faults) const {
  for (const Entry& entry : entries_) {
    faults.push_back({lane, entry.node >= 0 ? outputs[static_cast<std::size_t>(entry.node)] : "", entry.code,
                      entry.first, entry.last, entry.count, entry.stopped, entry.detail});
  }
}

}  // namespace vigil
