/// Interconnected plants in continuous time: subsystems of different sizes, coupled by their states.
/// Seed 002, eq. (1); specification (observer), section 1.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace vigil::observer {

/// What the known nonlinearity does with a state; every one is Lipschitz with constant tau.
enum class Nonlinearity { sine, tanh, sine_last, none };

/// x' = A x + B u + F Phi(x) + D w + Dd d - alpha sum_j H_ij x_j, y = C x + G f. Columns may be missing anywhere (n x
/// 0), of C no row may be. Sizes: n states, m inputs, p outputs, q attacks, dd disturbances, g faults, r
/// nonlinearities.
struct Subsystem {
  std::string name;
  Eigen::MatrixXd A, B, F, D, Dd;  ///< n x n, n x m, n x r, n x q, n x dd
  Eigen::MatrixXd C, G;            ///< p x n, p x g
  Eigen::MatrixXd E;               ///< p x p, regular; empty stands for the identity
  double alpha = 1;
  double tau = 0;               ///< Lipschitz constant of Phi
  std::optional<double> kappa;  ///< nothing: a variable of the design
  double mu = 1;                ///< scales the innovation; no effect on mu L
  double varsigma = 1;          ///< N = varsigma D2'
  Nonlinearity phi = Nonlinearity::sine;

  int n() const { return static_cast<int>(A.rows()); }
  int m() const { return static_cast<int>(B.cols()); }
  int p() const { return static_cast<int>(C.rows()); }
  int q() const { return static_cast<int>(D.cols()); }
  int dd() const { return static_cast<int>(Dd.cols()); }
  int g() const { return static_cast<int>(G.cols()); }
  int r() const { return static_cast<int>(F.cols()); }
  int size() const { return n() + g() + q(); }  ///< of the error e
};

/// x_to is driven by -alpha_to H x_from; H: n_to x n_from.
struct Coupling {
  int to = 0;
  int from = 0;
  Eigen::MatrixXd H;
};

struct Network {
  std::vector<Subsystem> subsystems;
  std::vector<Coupling> couplings;  ///< at most one for an ordered pair

  int count() const { return static_cast<int>(subsystems.size()); }
  /// Null where `from` does not drive `to`.
  const Eigen::MatrixXd* coupling(int to, int from) const;
};

inline constexpr int kMaxSize =
    50;  ///< of any dimension of a subsystem, and of their number: more has no design in time

/// Why a network is refused.
struct NetworkProblem {
  std::string matrix;  ///< "A", "C", "H_12", "kappa", …; "" for the subsystem as a whole
  int subsystem = -1;  ///< from 0; -1 for the network as a whole
  std::string reason;  ///< one sentence, the subsystem's name and the matrix included
};

/// Sizes, finite entries, ranks of C, D, G and E, parameters, and, where those are in order, whether attack, fault and
/// state can be told from the outputs at all. Specification, section 10. Empty: all is well.
std::vector<NetworkProblem> check(const Network& network);

/// Gives every empty matrix of a subsystem its proper n x 0 or p x 0 shape and E the identity, so that a description
/// may leave them out.
void complete(Subsystem& subsystem);

/// Phi(x), r entries: entry l is tau phi(x_(l mod n)) / sqrt(ceil(r / n)), Lipschitz tau as a whole. Specification,
/// section 7: tau sin(x_0) for r = 1.
void nonlinearity(const Subsystem& subsystem, const Eigen::Ref<const Eigen::VectorXd>& x,
                  Eigen::Ref<Eigen::VectorXd> phi);

}  // namespace vigil::observer
