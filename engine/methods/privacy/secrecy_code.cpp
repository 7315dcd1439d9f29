#include "engine/methods/privacy/secrecy_code.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "engine/linalg/small.hpp"

namespace vigil::privacy {

using Eigen::MatrixXd;

// d = xhat - xe obeys d+ = A d + {missed} g with the correction g = K (innovation); the error is x~ + d.
std::optional<MatrixXd> code_a_eavesdropper(const FusionModel& model, const StationaryFilters& filters,
                                            const Fusion& nominal, double loss) {
  std::vector<MatrixXd> F, noise;
  for (std::size_t i = 0; i < filters.gains.size(); ++i) {
    F.push_back(filters.gains[i].F);
    noise.push_back(filters.gains[i].K * model.sensors[i].R * filters.gains[i].K.transpose());
  }
  const auto sensors = F.size();
  const MatrixXd A = block_diagonal(std::vector<MatrixXd>(sensors, model.A)), Psi = block_diagonal(filters.Psi);
  const MatrixXd KC = block_diagonal(visible_gains(model, filters.gains)), own = block_diagonal(noise);
  const MatrixXd ahead = A * filters.P * A.transpose() + model.noise().replicate(model.count(), model.count());
  const auto G = solve_stein(A, Psi, loss * (KC * ahead * block_diagonal(F).transpose() - own));  // E[d x~']
  if (!G || !state_covariance(model)) return std::nullopt;
  const MatrixXd mixed = loss * A * *G * A.transpose() * KC.transpose();
  const auto D = solve_stein(A, A, mixed + mixed.transpose() + loss * (KC * ahead * KC.transpose() + own));
  if (!D) return std::nullopt;
  MatrixXd P = nominal.W * (filters.P + *G + G->transpose() + *D) * nominal.W.transpose();
  symmetrise(P);
  return P;
}

std::optional<std::vector<MatrixXd>> code_l(const FusionModel& model, const StationaryFilters& filters) {
  const auto S = state_covariance(model);
  const Eigen::FullPivLU<MatrixXd> A(model.A);
  if (!S || !A.isInvertible()) return std::nullopt;
  const int n = model.states();
  std::vector<MatrixXd> codes;
  for (int i = 0; i < model.count(); ++i) {
    const MatrixXd Si = *S - filters.P.block(i * n, i * n, n, n);
    codes.push_back(Si.ldlt().solve(A.solve(Si)).transpose());
  }
  return codes;
}

}  // namespace vigil::privacy
