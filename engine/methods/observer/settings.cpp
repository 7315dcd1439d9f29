#include "engine/methods/observer/settings.hpp"

#include <fmt/format.h>

#include "engine/methods/observer/matched.hpp"
#include "engine/methods/observer/printed_gains.hpp"
#include "engine/world/interconnected/plant.hpp"

namespace vigil::observer {
namespace {

Network network_of(const Plant& plant) {
  const auto* own = dynamic_cast<const InterconnectedPlant*>(&plant);
  if (own == nullptr) {
    throw InputError("/",
                     "this method observes interconnected subsystems in continuous time; expected a plant of type "
                     "pair, areas, single or interconnected",
                     "pair, areas, single, interconnected");
  }
  return own->network();
}

/// One value a subsystem, each above `least` (exclusive) where that is asked for; nothing where the parameter is null.
std::optional<Eigen::VectorXd> one_each(const Params& params, const char* name, int count, bool positive) {
  if (!params.given(name)) return std::nullopt;
  Eigen::VectorXd values = params.vector(name);
  if (values.size() != count) {
    throw InputError(std::string("/") + name,
                     fmt::format("{} has {} entries; expected {}, one a subsystem", name, values.size(), count));
  }
  if (positive && !(values.minCoeff() > 0))
    throw InputError(std::string("/") + name, fmt::format("{} has an entry that is not above 0", name), "> 0");
  return values;
}

void tune(Network& network, const Params& params) {
  const int count = network.count();
  const auto kappa = one_each(params, "kappa", count, true), mu = one_each(params, "mu", count, true);
  const auto varsigma = one_each(params, "varsigma", count, false);
  for (int i = 0; i < count; ++i) {
    Subsystem& s = network.subsystems[static_cast<std::size_t>(i)];
    if (kappa) s.kappa = (*kappa)[i];
    if (mu) s.mu = (*mu)[i];
    if (varsigma) s.varsigma = (*varsigma)[i];
  }
}

void override_options(SynthesisOptions& options, const Params& params) {
  if (params.given("pmin")) options.pmin = params.real("pmin");
  if (params.given("pmax")) options.pmax = params.real("pmax");
  if (params.given("cnu")) options.cnu = params.real("cnu");
  if (params.given("eps")) options.eps = params.real("eps");
  if (options.pmax && !(*options.pmax > options.pmin))
    throw InputError("/pmax", fmt::format("pmax is {}; expected above pmin, {}", *options.pmax, options.pmin));
}

/// A block-diagonal matrix, N_i x p_i each.
Gains split(const Eigen::MatrixXd& L, const Network& network) {
  Eigen::Index rows = 0, columns = 0;
  for (const Subsystem& s : network.subsystems) {
    rows += s.size();
    columns += s.p();
  }
  if (L.rows() != rows || L.cols() != columns) {
    throw InputError("/L", fmt::format("L is {} x {}; expected {} x {}: every subsystem's gains, states, faults and "
                                       "attacks by outputs, as blocks on the diagonal",
                                       L.rows(), L.cols(), rows, columns));
  }
  Gains gains;
  Eigen::Index row = 0, column = 0;
  for (const Subsystem& s : network.subsystems) {
    gains.push_back(L.block(row, column, s.size(), s.p()));
    row += s.size();
    column += s.p();
  }
  return gains;
}

Gains printed_for(const Network& network) {
  Gains gains = printed_gains();
  bool fits = gains.size() == network.subsystems.size();
  for (std::size_t i = 0; fits && i < gains.size(); ++i) {
    const Subsystem& s = network.subsystems[i];
    fits = gains[i].rows() == s.size() && gains[i].cols() == s.p();
  }
  if (!fits) throw InputError("/gains", "the source prints gains for its example 3.1 alone, the plant \"pair\"");
  return gains;
}

}  // namespace

Settings intermediate_settings(const Params& params, const Plant& plant) {
  Settings settings;
  settings.network = network_of(plant);
  tune(settings.network, params);
  settings.options = params.text("preset") == "fast" ? fast() : ref();
  override_options(settings.options, params);
  if (params.given("cd")) settings.options.cd = params.real("cd");
  if (params.given("cw")) settings.options.cw = params.real("cw");
  if (params.given("rmax")) settings.options.rmax = params.real("rmax");
  settings.options.free_kappa = params.boolean("free_kappa");
  if (params.text("structure") == "classical") settings.options.structure = Structure::classical;
  settings.weights = {params.real("qd"), params.real("qf"), params.real("qw")};
  const std::string source = params.text("gains");
  if (source == "printed") {
    settings.source = Source::printed;
    settings.gains = printed_for(settings.network);
  } else if (source == "given") {
    if (!params.given("L")) throw InputError("/L", "L is missing, since gains is \"given\"");
    settings.source = Source::given;
    settings.gains = split(params.matrix("L"), settings.network);
  } else if (source == "riccati") {
    settings.source = Source::riccati;
  }
  settings.system = error_system(settings.network);
  return settings;
}

Settings matched_settings(const Params& params, const Plant& plant) {
  Settings settings;
  settings.network = network_of(plant);
  settings.options = matched();
  override_options(settings.options, params);
  for (const Subsystem& s : settings.network.subsystems) {
    if (s.r() > 0) {
      throw InputError("/",
                       fmt::format("subsystem {} has a nonlinearity F Phi; the matched observer knows none", s.name));
    }
  }
  settings.system = matched_error_system(settings.network);
  return settings;
}

}  // namespace vigil::observer
