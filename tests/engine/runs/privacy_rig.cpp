#include "tests/engine/runs/privacy_rig.hpp"

namespace vigil::test {

Told004::Told004(const Scenario& scenario, std::uint64_t seed, std::shared_ptr<const Trace> trace)
    : run(scenario, {seed, std::move(trace), {}}) {
  run_to_end(run, capture);
}

double Told004::at(const std::string& signal, int k) const {
  const int id = run.catalogue().find(signal);
  EXPECT_GE(id, 0) << signal;
  return id < 0 ? 0 : capture.frames.at(static_cast<std::size_t>(k)).values[static_cast<std::size_t>(id)];
}

Scenario privacy(const std::string& which, const Json& patch) {
  return Scenario::preset("privacy-" + which).patched(patch);
}

}  // namespace vigil::test
