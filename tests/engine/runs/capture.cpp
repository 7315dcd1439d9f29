#include "tests/engine/runs/capture.hpp"

namespace vigil::test {

void run_to_end(vigil::Run& run, Sink& sink) {
  while (!run.done()) run.step(sink);
}

std::string csv_of(const Catalogue& catalogue, const std::vector<Frame>& frames) {
  std::string text = csv_header(catalogue);
  for (const Frame& frame : frames) append_csv_row(text, frame);
  return text;
}

void expect_same(const vigil::Run& a, const Capture& left, const vigil::Run& b, const Capture& right,
                 const std::string& prefix) {
  ASSERT_EQ(left.frames.size(), right.frames.size());
  int compared = 0;
  for (const Signal& signal : a.catalogue().all()) {
    if (signal.name.compare(0, prefix.size(), prefix) != 0) continue;
    const int other = b.catalogue().find(signal.name);
    ASSERT_GE(other, 0) << signal.name;
    ++compared;
    for (std::size_t k = 0; k < left.frames.size(); ++k) {
      const double x = left.frames[k].values[static_cast<std::size_t>(signal.id)],
                   y = right.frames[k].values[static_cast<std::size_t>(other)];
      ASSERT_TRUE(same_bits(x, y)) << signal.name << " at tick " << k << ": " << x << " and " << y;
    }
  }
  EXPECT_GT(compared, 0) << "no signal begins with " << prefix;
}

double metric(const std::vector<MetricValue>& metrics, const std::string& lane, const std::string& name,
              const std::string& node) {
  for (const MetricValue& m : metrics) {
    if (m.lane == lane && m.name == name && m.node == node) return m.value;
  }
  ADD_FAILURE() << "no metric " << name << " of " << lane << " " << node;
  return 0;
}

void expect_refused(const Json& document, const std::string& pointer) {
  try {
    const vigil::Run run(Scenario::from_json(document), {1, nullptr, {}});
    ADD_FAILURE() << "accepted; expected a problem at " << pointer;
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().front().pointer, pointer) << error.what();
  }
}

}  // namespace vigil::test
