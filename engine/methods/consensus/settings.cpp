#include <fmt/format.h>

#include "engine/methods/consensus/filter.hpp"

namespace vigil::consensus {
namespace {

constexpr double kShareOfLimit = 0.9;  // eps "auto": 0.9/d_max, 0.3 without edges

void check_delta(const Params& params, const std::vector<LinkRates>& rates) {
  if (!params.given("delta")) return;
  double norm = 0;
  for (const LinkRates& rate : rates) norm = std::max(norm, rate.delta);
  const double delta = params.real("delta");
  if (delta < norm * 0.999) {
    throw InputError(
        "/delta",
        fmt::format("delta is {}; the adversary injects vectors of norm up to {}, so the bound would not hold", delta,
                    norm),
        fmt::format(">= {}", norm));
  }
}

}  // namespace

Settings read_settings(const Params& params, int states, const Graph& graph, const std::vector<LinkRates>& rates) {
  Settings settings;
  settings.raw = params;
  Constants& constants = settings.constants;
  constants.tau = params.real("tau");
  constants.sigma = params.real("sigma");
  constants.beta = params.real("beta");
  constants.rho = params.real("rho");
  const int d_max = graph.max_degree();
  settings.automatic_eps = !params.given("eps");
  if (settings.automatic_eps) {
    constants.eps = d_max == 0 ? 0.3 : kShareOfLimit / d_max;
  } else {
    constants.eps = params.real("eps");
    if (constants.eps * d_max >= 1) {
      throw InputError("/eps",
                       fmt::format("eps is {}; with a largest degree of {} it must lie in (0, {:.6g})", constants.eps,
                                   d_max, 1.0 / d_max),
                       fmt::format("0 < eps < {:.6g}", 1.0 / d_max));
    }
  }
  const std::string guard = params.text("guard");
  constants.guard = guard == "clip"     ? Guard::clip
                    : guard == "strict" ? Guard::strict
                    : guard == "none"   ? Guard::none
                                        : Guard::adapt;
  const std::string bound = params.text("bound");
  constants.bound = bound == "paper" ? Bound::paper : bound == "corrected" ? Bound::corrected : Bound::tight;
  const std::string mode = params.text("mode");
  settings.mode = mode == "filter"       ? Mode::filter
                  : mode == "drop"       ? Mode::drop
                  : mode == "naive_hold" ? Mode::naive_hold
                                         : Mode::naive_zero;
  settings.knows_rates = params.boolean("knows_rates");
  if (params.given("phibar")) settings.phibar = params.real("phibar");
  if (params.given("gammabar")) settings.gammabar = params.real("gammabar");
  if (params.given("delta")) settings.delta = params.real("delta");
  if (settings.phibar.value_or(0) + settings.gammabar.value_or(0) > 1) {
    throw InputError("/gammabar", "phibar + gammabar is above 1; a channel has at most one of the two",
                     "phibar + gammabar <= 1");
  }
  check_delta(params, rates);
  settings.U = params.square("U", states);
  return settings;
}

std::vector<LinkRates> effective_rates(const Settings& settings, const std::vector<LinkRates>& published) {
  std::vector<LinkRates> rates = published;
  for (LinkRates& rate : rates) {
    if (!settings.knows_rates) rate = {0, 0, rate.delta};
    if (settings.phibar) rate.dos = *settings.phibar;
    if (settings.gammabar) rate.fdi = *settings.gammabar;
    if (settings.delta) rate.delta = *settings.delta;
    if (settings.mode == Mode::drop) rate = {rate.dos + rate.fdi, 0, rate.delta};
    if (settings.mode == Mode::naive_hold || settings.mode == Mode::naive_zero) rate = {0, 0, rate.delta};
  }
  return rates;
}

}  // namespace vigil::consensus
