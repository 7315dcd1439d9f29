/// What must hold for any bytes at all; shared by the fuzzers and the seeded mutation tests.
#pragma once

#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

#include "engine/core/describe.hpp"
#include "engine/core/input_error.hpp"
#include "engine/run/run.hpp"
#include "engine/run/trace.hpp"
#include "engine/scenario/document.hpp"
#include "engine/scenario/scenario.hpp"

namespace vigil::fuzz {

inline void require(bool condition, const char* what) {
  if (!condition) throw std::logic_error(what);
}

/// A refusal names what is wrong in words that can be sent on.
inline void check_refusal(const InputError& error) {
  require(!error.problems().empty(), "a refusal without a problem");
  for (const auto& problem : error.problems()) {
    require(!problem.detail.empty(), "a problem without words");
    require(is_utf8(problem.detail) && is_utf8(problem.pointer) && is_utf8(problem.allowed),
            "a problem that is not UTF-8");
    require(problem.pointer.empty() || problem.pointer.front() == '/', "a pointer that is none");
  }
}

/// Refused, or complete: then reading it again changes nothing. True where accepted.
inline bool scenario_case(const Json& given) {
  try {
    const Scenario scenario = Scenario::from_json(given);
    const std::string text = scenario.document().dump();
    require(Scenario::from_json(Json::parse(text)).document().dump() == text,
            "a document that changes when read again");
    require(scenario.patched(Json::object()).document().dump() == text, "an empty patch that changes something");
    live_paths(scenario.document());
    return true;
  } catch (const InputError& error) {
    check_refusal(error);
    return false;
  }
}

inline bool scenario_case(std::string_view text) {
  const Json given = Json::parse(text, nullptr, false);
  return !given.is_discarded() && scenario_case(given);
}

/// Refused, or a patched preset. True where accepted.
inline bool patch_case(const Json& patch) {
  try {
    return scenario_case(Scenario::preset("consensus").patched(patch).document());
  } catch (const InputError& error) {
    check_refusal(error);
    return false;
  }
}

inline bool with_case(std::string_view path, const Json& value) {
  try {
    return scenario_case(Scenario::preset("consensus").with(path, value).document());
  } catch (const InputError& error) {
    check_refusal(error);
    return false;
  }
}

/// Looks at every frame: numbers are finite or missing.
class FiniteSink final : public Sink {
 public:
  void frame(const Frame& frame) override {
    for (const double value : frame.values) require(!std::isinf(value), "an infinite value in a frame");
  }
  void mark(const Mark& mark) override {
    require(mark_from_json(to_json(mark)).k == mark.k, "a mark that does not come back");
  }
};

/// Refused, or a run of a few ticks whose every number is finite or missing. True where it ran.
inline bool run_case(const Json& document) {
  try {
    Run run(Scenario::from_json(document), {});
    FiniteSink sink;
    for (int n = 0; n < 4; ++n) run.step(sink);
    for (const auto& metric : run.metrics()) to_json(metric).dump();
    run.design().dump();
    run.world().dump();
    return true;
  } catch (const InputError& error) {
    check_refusal(error);
    return false;
  }
}

/// A text as the trace of a run: refused, or a run whose every number is finite or missing. True where it ran.
inline bool recorded_case(std::string_view text) {
  try {
    static const Scenario scenario = Scenario::preset("consensus");
    RunOptions options;
    options.trace = std::make_shared<const Trace>(Trace::from_csv(text, 1'000'000));
    Run run(scenario, options);
    FiniteSink sink;
    for (int n = 0; n < 6; ++n) run.step(sink);
    return true;
  } catch (const InputError& error) {
    check_refusal(error);
    return false;
  }
}

/// Refused, or applied to a copy of the run, which goes on. True where accepted.
inline bool command_case(const Run& before, const Json& body) {
  try {
    Run run(before);
    run.apply(run.prepare(body));
    FiniteSink sink;
    for (int n = 0; n < 2; ++n) run.step(sink);
    return true;
  } catch (const InputError& error) {
    check_refusal(error);
    return false;
  }
}

/// Refused, or rows of finite or missing numbers. True where accepted.
inline bool trace_case(std::string_view text) {
  try {
    const Trace trace = Trace::from_csv(text, 1'000'000);
    require(trace.rows() > 0 && std::isfinite(trace.dt()) && trace.dt() >= 0, "a trace without rows or step");
    const auto columns = static_cast<int>(trace.columns().size());
    for (int column = 0; column < columns; ++column) {
      require(trace.find(trace.columns()[static_cast<std::size_t>(column)]) == column, "a column that is not found");
      for (std::int64_t row = 0; row < trace.rows(); ++row) {
        require(!std::isinf(trace.at(trace.first_tick() + row, column)), "an infinite cell");
      }
    }
    return true;
  } catch (const InputError& error) {
    check_refusal(error);
    return false;
  }
}

}  // namespace vigil::fuzz
