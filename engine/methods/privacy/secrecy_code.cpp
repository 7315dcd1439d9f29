#include "engine/methods/privacy/secrecy_code.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <utility>

#include "engine/linalg/small.hpp"

namespace vigil::privacy {

using Eigen::MatrixXd;

namespace {

constexpr double kSwallows = 1e9;

}  // namespace

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

CodeAError::CodeAError(const FusionModel& model, const StationaryFilters& filters, double loss)
    : A_(block_diagonal(std::vector<MatrixXd>(filters.gains.size(), model.A))),
      Psi_(block_diagonal(filters.Psi)),
      P_(filters.P),
      ahead_(P_),
      mixed_(P_) {
  const MatrixXd KC = block_diagonal(visible_gains(model, filters.gains));
  const int n = model.states(), L = model.count();
  std::vector<MatrixXd> F, noise, own;
  for (int i = 0; i < L; ++i) {
    const LocalGains& gains = filters.gains[static_cast<std::size_t>(i)];
    F.push_back(gains.F);
    noise.push_back(gains.K * model.sensors[static_cast<std::size_t>(i)].R * gains.K.transpose());
    own.push_back(P_.block(i * n, i * n, n, n));
  }
  const MatrixXd ahead = A_ * P_ * A_.transpose() + model.noise().replicate(L, L), V = block_diagonal(noise);
  seen_ = loss * A_.transpose() * KC.transpose();
  enters_G_ = loss * (KC * ahead * block_diagonal(F).transpose() - V);
  enters_D_ = loss * (KC * ahead * KC.transpose() + V);
  if (const auto S = state_covariance(model)) {  // E[x x~_j'] = P_jj
    const MatrixXd known = stack(n, L) * column_of(own).transpose();
    G_ = loss * (known - P_);
    D_ = loss * (S->replicate(L, L) - known - known.transpose() + P_);
  } else {
    G_ = -loss * P_;
    D_ = loss * P_;
  }
}

void CodeAError::step() {
  ahead_.noalias() = A_ * G_;
  mixed_.noalias() = ahead_ * seen_;
  G_.noalias() = ahead_ * Psi_.transpose();
  G_ += enters_G_;
  ahead_.noalias() = A_ * D_;
  D_.noalias() = ahead_ * A_.transpose();
  D_ += mixed_ + mixed_.transpose();
  D_ += enters_D_;
}

double CodeAError::trace(const MatrixXd& W) const {
  return (W * (P_ + G_ + G_.transpose() + D_)).cwiseProduct(W).sum();
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

std::optional<MatrixXd> code_l_state(const FusionModel& model) {
  const auto S = state_covariance(model);
  const Eigen::FullPivLU<MatrixXd> A(model.A);
  if (!S || !A.isInvertible()) return std::nullopt;
  return MatrixXd(S->ldlt().solve(A.solve(*S)).transpose());
}

CodeMemory::CodeMemory(MatrixXd Lc) : Lc_(std::move(Lc)), base_(Eigen::VectorXd::Zero(Lc_.rows())), next_(base_) {}

void CodeMemory::advance() {
  next_.noalias() = Lc_ * base_;
  base_.swap(next_);
  if (base_.norm() < kSwallows) return;
  base_.setZero();
  restarted_ = true;
}

const Eigen::VectorXd& CodeMemory::decode(const Eigen::Ref<const Eigen::VectorXd>& message) {
  base_ += message;
  return base_;
}

// Y = (x, x~ of all sensors) obeys Y+ = Psi_Y Y + noise; a message is an image of Y and of Y a tick before.
RecentMessages::RecentMessages(const FusionModel& model, const StationaryFilters& filters, const MatrixXd& S,
                               const std::vector<MatrixXd>& Lc, int depth)
    : states_(model.states()), depth_(depth), S_(S) {
  const int n = model.states(), stacked = model.stacked(), all = n + stacked;
  const MatrixXd chain = block_diagonal({model.A, block_diagonal(filters.Psi)});
  MatrixXd law(all, all), estimates(stacked, all);
  law << S, MatrixXd::Zero(n, stacked), MatrixXd::Zero(stacked, n), filters.P;
  for (int at = n; at < all; at += n) {
    law.block(at, 0, n, n) = filters.P.block(at - n, at - n, n, n);
    law.block(0, at, n, n) = law.block(at, 0, n, n).transpose();
  }
  estimates << stack(n, model.count()), -MatrixXd::Identity(stacked, stacked);

  const int ticks = depth + 1;
  MatrixXd joint(ticks * all, ticks * all), messages = MatrixXd::Zero(depth * stacked, ticks * all);
  for (int later = 0; later < ticks; ++later) {
    MatrixXd cross = law;  // E[Y(t - later) Y(t - earlier)']
    for (int earlier = later; earlier < ticks; ++earlier) {
      joint.block(later * all, earlier * all, all, all) = cross;
      joint.block(earlier * all, later * all, all, all) = cross.transpose();
      cross = (chain * cross).eval();
    }
  }
  for (int m = 0; m < depth; ++m) {
    messages.block(m * stacked, m * all, stacked, all) = estimates;
    messages.block(m * stacked, (m + 1) * all, stacked, all) = -block_diagonal(Lc) * estimates;
  }
  X_ = joint.topRows(n) * messages.transpose();
  Z_ = messages * joint * messages.transpose();
  symmetrise(Z_);
}

RecentMessages::Best RecentMessages::best(const std::vector<char>& heard) const {
  std::vector<Eigen::Index> rows;
  for (std::size_t m = 0; m < heard.size(); ++m) {
    if (!heard[m]) continue;
    for (int j = 0; j < states_; ++j) rows.push_back(static_cast<Eigen::Index>(m) * states_ + j);
  }
  Best best{.gain = MatrixXd::Zero(states_, Z_.rows()), .trace = S_.trace()};
  if (rows.empty()) return best;
  const MatrixXd X = X_(Eigen::all, rows);
  const MatrixXd gain = X * symmetric_pseudo_inverse(Z_(rows, rows));
  best.gain(Eigen::all, rows) = gain;
  best.trace -= gain.cwiseProduct(X).sum();
  return best;
}

}  // namespace vigil::privacy
