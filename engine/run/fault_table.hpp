/// Faults of one lane, counted by output and code, with marks at the begin and end of each spell and none in between.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/methods/method.hpp"
#include "engine/run/run.hpp"

namespace vigil {

class FaultTable final : public FaultReport {
 public:
  FaultTable() { entries_.reserve(kExpected); }
  FaultTable(const FaultTable& other) : entries_(other.entries_), k_(other.k_), stopped_(other.stopped_) {
    entries_.reserve(kExpected);
  }
  FaultTable& operator=(const FaultTable&) = delete;

  void begin_tick(std::int64_t k) { k_ = k; }
  std::string* fault(int node, const char* code) override;
  std::string* stop(int node, const char* code) override;
  bool stopped() const { return stopped_; }

  /// Marks the spells that began or ended with this tick.
  void mark_edges(const std::string& lane, const std::vector<std::string>& outputs, Sink& sink);
  void append(const std::string& lane, const std::vector<std::string>& outputs, std::vector<FaultCount>& faults) const;

 private:
  static constexpr std::size_t kExpected = 64;  // so that an ordinary run never grows the table in a tick
  struct Entry {
    int node;
    const char* code;
    std::int64_t first, last, count;
    bool open, stopped;
    std::string detail;
  };
  Entry& find(int node, const char* code, bool& fresh);

  std::vector<Entry> entries_;
  std::int64_t k_ = 0;
  bool stopped_ = false;
};

}  // namespace vigil
