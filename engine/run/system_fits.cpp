#include "engine/run/system_fits.hpp"

#include "engine/core/registry.hpp"
#include "engine/methods/method.hpp"
#include "engine/run/design.hpp"
#include "engine/run/run.hpp"

namespace vigil {
namespace {

struct Fit {
  bool needs_gains = false;
  Json reason, pointer;
  std::vector<std::string> warnings;
};

/// Whether a document that is not yet a scenario would start.
Fit fit_of(const Json& document) {
  Fit fit;
  try {
    const Scenario scenario = Scenario::from_json(document);
    fit.needs_gains = !design_tasks(scenario).empty();
    if (!fit.needs_gains) fit.warnings = Run(scenario, {}).warnings();
  } catch (const InputError& error) {
    fit.reason = error.problems().front().detail;
    fit.pointer = error.problems().front().pointer;
  }
  return fit;
}

}  // namespace

Json method_fits(const Scenario& scenario) {
  Json document = scenario.document();
  document["adversary"] = Json::object();
  Json list = Json::array();
  for (const auto& method : Registry<MethodMake>::all()) {
    document["lanes"] = {{"check", {{"method", method.id}}}};
    const Fit fit = fit_of(document);
    list.push_back({{"id", method.id},
                    {"title", {{"en", method.title.en}, {"zh", method.title.zh}}},
                    {"fits", fit.reason.is_null()},
                    {"reason", fit.reason},
                    {"pointer", fit.pointer},
                    {"needs_gains", fit.needs_gains}});
  }
  return list;
}

Json run_fit(const Scenario& scenario) {
  const Fit fit = fit_of(scenario.document());
  return {
      {"starts", fit.reason.is_null()}, {"reason", fit.reason}, {"pointer", fit.pointer}, {"warnings", fit.warnings}};
}

}  // namespace vigil
