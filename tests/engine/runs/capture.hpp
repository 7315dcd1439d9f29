// What a run emits, kept.
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "engine/run/frame_csv.hpp"
#include "engine/run/run.hpp"
#include "engine/run/trace.hpp"

namespace vigil::test {

class Capture final : public Sink {
 public:
  void frame(const Frame& frame) override { frames.push_back(frame); }
  void mark(const Mark& mark) override { marks.push_back(mark); }
  std::vector<Frame> frames;
  std::vector<Mark> marks;
};

void run_to_end(vigil::Run& run, Sink& sink);

std::string csv_of(const Catalogue& catalogue, const std::vector<Frame>& frames);

inline bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0 || (a != a && b != b); }

/// Every signal of `names` (empty: every one with the prefix) has the same bits in both captures.
void expect_same(const vigil::Run& a, const Capture& left, const vigil::Run& b, const Capture& right,
                 const std::string& prefix);

double metric(const std::vector<MetricValue>& metrics, const std::string& lane, const std::string& name,
              const std::string& node = "");

/// The document, or a run of it, is refused with its first problem at this pointer.
void expect_refused(const Json& document, const std::string& pointer);

}  // namespace vigil::test
