// metrics.window of a document: only its ticks count.
#include <cmath>

#include "engine/run/run.hpp"

namespace vigil::window_test {
namespace {

class KeepErrors final : public Sink {
 public:
  explicit KeepErrors(int id) : id_(id) {}
  void frame(const Frame& frame) override { errors.push_back(frame.values[static_cast<std::size_t>(id_)]); }
  void mark(const Mark& /*mark*/) override {}
  std::vector<double> errors;

 private:
  int id_;
};

TEST(MetricsWindow, ScoresOnlyItsTicks) {
  const Scenario scenario =
      Scenario::preset("consensus").patched({{"metrics", {{"window", {{"from", 5}, {"to", 9}}}}}});
  vigil::Run run(scenario, {3, nullptr, {}});
  KeepErrors sink(run.catalogue().find("lane.centralized.fused.error"));
  while (!run.done()) run.step(sink);
  double square = 0;
  for (int k = 5; k <= 9; ++k)
    square += sink.errors[static_cast<std::size_t>(k)] * sink.errors[static_cast<std::size_t>(k)] / 5;
  for (const MetricValue& metric : run.metrics()) {
    if (metric.lane != "centralized" || metric.name != "rmse_position") continue;
    EXPECT_NEAR(metric.value, std::sqrt(square), 1e-12);
  }
}

}  // namespace
}  // namespace vigil::window_test
