#include "engine/methods/privacy/dp_surfaces.hpp"

#include <vector>

#include "engine/methods/privacy/gaussian_mechanism.hpp"

namespace vigil::privacy {
namespace {

const std::vector<double> kKappas{1, 2, 3, 5, 7, 10, 15, 20, 30, 40, 60, 80, 100};
const std::vector<double> kEpsilons{0.1, 0.15, 0.2, 0.3, 0.5, 0.7, 1, 1.5, 2, 3, 5};
const std::vector<double> kDeltas{0.001, 0.003, 0.01, 0.03, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4};

/// Both traces where the sensors' noise has another variance.
class Traces {
 public:
  explicit Traces(const DpFusion& design)
      : design_(design), unit_((design.Pc - design.filters.P) / design.q_total), n_(design.nominal.P.rows()) {}
  double pdfe(double q) const { return design_.nominal.P.trace() + static_cast<double>(n_) * q; }
  double cdfe(double q) const { return fuse(design_.filters.P + q * unit_, static_cast<int>(n_)).P.trace(); }

 private:
  const DpFusion& design_;
  Eigen::MatrixXd unit_;  ///< of what the sensors send, for the variance 1
  Eigen::Index n_;
};

}  // namespace

Json dp_surfaces(const DpFusion& design, const DpSettings& settings) {
  const Traces traces(design);
  Json along{{"values", kKappas}}, plane{{"epsilon", kEpsilons}, {"delta", kDeltas}};
  for (const double kappa : kKappas) {
    const double q = design.q_centre / kappa;
    along["pdfe"].push_back(traces.pdfe(q));
    along["cdfe"].push_back(traces.cdfe(q));
  }
  for (const double epsilon : kEpsilons) {
    Json pdfe = Json::array(), cdfe = Json::array();
    for (const double delta : kDeltas) {
      const double deviation = gamma_factor(epsilon, delta) * design.sigma * settings.lambda;
      const double q = deviation * deviation / settings.kappa;
      pdfe.push_back(traces.pdfe(q));
      cdfe.push_back(traces.cdfe(q));
    }
    plane["pdfe"].push_back(pdfe);
    plane["cdfe"].push_back(cdfe);
  }
  return {{"kappa", along}, {"epsilon_delta", plane}};
}

}  // namespace vigil::privacy
