#include "engine/methods/observer/certificate.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <algorithm>
#include <limits>

#include "engine/methods/observer/inequality.hpp"

namespace vigil::observer {
namespace {

using Matrix = Eigen::MatrixXd;

Eigen::VectorXd eigenvalues(const Matrix& M) {
  return Eigen::SelfAdjointEigenSolver<Matrix>(M, Eigen::EigenvaluesOnly).eigenvalues();
}

double spectral_norm(const Matrix& M) { return M.size() == 0 ? 0 : Eigen::JacobiSVD<Matrix>(M).singularValues()[0]; }

std::string reason_against(const Certificate& c, double eps) {
  if (!(c.lambda_min_p > 0)) return fmt::format("P is not definite: its smallest eigenvalue is {:.3g}", c.lambda_min_p);
  const double wanted = -eps / 2;
  if (!(eps > 0 ? c.lambda_max_sigma <= wanted : c.lambda_max_sigma < 0)) {
    return fmt::format("the inequality does not hold: Sigma's largest eigenvalue is {:.3g}, at most {:.3g} is needed",
                       c.lambda_max_sigma, wanted);
  }
  if (!(c.max_real_pole < 0))
    return fmt::format("the errors do not decay: a pole has the real part {:.3g}", c.max_real_pole);
  return "";
}

}  // namespace

Matrix sigma(const ErrorSystem& system, const Design& design) {
  std::vector<int> first{0};
  for (const ErrorPart& part : system.parts) first.push_back(first.back() + sigma_order(part));
  Matrix S = Matrix::Zero(first.back(), first.back());
  for (std::size_t i = 0; i < system.parts.size(); ++i) {
    const Parts parts{.P = design.P[i],
                      .W = design.P[i] * design.L[i],
                      .gd2 = design.gamma_d[i] * design.gamma_d[i],
                      .gw2 = design.gamma_w[i] * design.gamma_w[i],
                      .kappa = design.kappa[i]};
    add_sigma(system, i, parts, first, S);
    add_sigma_constant(system.parts[i], first[i], S);
  }
  return S;
}

Certificate poles_only(const ErrorSystem& system, const Gains& gains) {
  Certificate c;
  for (const Matrix& L : gains) c.norm_l.push_back(spectral_norm(L));
  const Matrix errors = global_error_matrix(system, gains);
  if (!errors.allFinite()) {
    c.max_real_pole = std::numeric_limits<double>::infinity();
    c.reason = "the gains are not finite";
    return c;
  }
  c.poles = poles(errors);
  c.max_real_pole = c.poles.empty() ? 0 : c.poles.front().real();
  for (const auto& pole : c.poles) c.fastest_pole = std::max(c.fastest_pole, std::abs(pole));
  c.reason = "gains without a design have no certificate";
  return c;
}

Certificate certify(const Synthesis& synthesis, const Design& design, const Eigen::VectorXd& y) {
  Certificate c = poles_only(synthesis.system, design.L);
  if (c.poles.empty()) return c;
  if (y.size() == synthesis.problem.variables()) c.margins = smallest_eigenvalues(synthesis.problem, y);
  c.lambda_max_sigma = eigenvalues(sigma(synthesis.system, design)).maxCoeff();
  c.lambda_min_p = std::numeric_limits<double>::infinity();
  for (const Matrix& P : design.P) c.lambda_min_p = std::min(c.lambda_min_p, eigenvalues(P)[0]);
  c.reason = reason_against(c, synthesis.options.eps);
  c.holds = c.reason.empty();
  return c;
}

}  // namespace vigil::observer
