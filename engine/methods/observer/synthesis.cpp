#include "engine/methods/observer/synthesis.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <stdexcept>

#include "engine/methods/observer/inequality.hpp"

namespace vigil::observer {
namespace {

using Matrix = Eigen::MatrixXd;

/// Hands out the places in y.
class Layout {
 public:
  int take(int count) {
    const int first = next_;
    next_ += count;
    return first;
  }
  int count() const { return next_; }

 private:
  int next_ = 0;
};

int triangle(int order) { return order * (order + 1) / 2; }

bool classical(const Synthesis& synthesis) { return synthesis.options.structure == Structure::classical; }

/// Rows of xi: all of e where there is no theta.
int upper_rows(const ErrorPart& part) { return static_cast<int>(part.Abar.rows()) - part.integral; }

void lay_out(Synthesis& synthesis) {
  Layout layout;
  const bool design = synthesis.given.empty();
  for (const ErrorPart& part : synthesis.system.parts) {
    const int size = static_cast<int>(part.Abar.rows()), p = static_cast<int>(part.Cbar.rows());
    const bool split = classical(synthesis);
    Unknowns at;
    at.P = layout.take(split ? triangle(upper_rows(part)) + triangle(part.integral) : triangle(size));
    if (design) at.W = layout.take((split ? upper_rows(part) : size) * p);
    if (part.Kbar.cols() > 0) at.gd2 = layout.take(1);
    if (part.Wbar.cols() > 0) at.gw2 = layout.take(1);
    if (design) at.nu = layout.take(1);
    if (part.Fbar.cols() > 0 && (!part.kappa || synthesis.options.free_kappa)) at.kappa = layout.take(1);
    synthesis.unknowns.push_back(at);
  }
  if (layout.count() > kMaxVariables) {
    throw std::length_error(
        fmt::format("the design has {} unknowns; at most {} are solved for", layout.count(), kMaxVariables));
  }
  synthesis.problem.cost.assign(static_cast<std::size_t>(layout.count()), 0);
}

/// Writes the entries of one problem: every unknown's matrix is what the inequality's linear part makes of a unit.
class Builder {
 public:
  explicit Builder(Synthesis& synthesis) : s_(synthesis), problem_(synthesis.problem) {
    for (const ErrorPart& part : s_.system.parts)
      first_.push_back(sigma_order(part) + (first_.empty() ? 0 : first_.back()));
    first_.insert(first_.begin(), 0);
  }

  void run() {
    reserve_blocks();
    for (std::size_t i = 0; i < s_.system.parts.size(); ++i) {
      constants(i);
      unknowns_of_p(i);
      if (s_.unknowns[i].W >= 0) unknowns_of_w(i);
      scalars(i);
    }
    canonicalise(problem_);
  }

 private:
  void reserve_blocks() {
    problem_.blocks.push_back(first_.back());
    const auto block = [&](int order) {
      problem_.blocks.push_back(order);
      return static_cast<int>(problem_.blocks.size()) - 1;
    };
    const auto each = [&](std::vector<int>& places, auto order) {
      for (const ErrorPart& part : s_.system.parts) places.push_back(block(static_cast<int>(order(part))));
    };
    each(above_, [](const ErrorPart& part) { return part.Abar.rows(); });
    if (s_.options.pmax) each(below_, [](const ErrorPart& part) { return part.Abar.rows(); });
    if (s_.given.empty()) each(bounded_, [](const ErrorPart& part) { return part.Cbar.rows() + part.Abar.rows(); });
    if (s_.options.rmax) each(slow_, [](const ErrorPart& part) { return part.Abar.rows(); });
  }

  void put(int matrix, int block, const Matrix& M) {
    for (Eigen::Index column = 0; column < M.cols(); ++column) {
      for (Eigen::Index row = 0; row <= column; ++row) {
        if (M(row, column) == 0) continue;
        problem_.entries.push_back({matrix, block, static_cast<int>(row), static_cast<int>(column), M(row, column)});
      }
    }
  }

  /// F_0: minus the blocks' values at y = 0.
  void constants(std::size_t i) {
    const ErrorPart& part = s_.system.parts[i];
    Matrix S = Matrix::Zero(first_.back(), first_.back());
    add_sigma_constant(part, first_[i], S);
    S.diagonal().segment(first_[i], sigma_order(part)).array() += s_.options.eps;
    if (part.Fbar.cols() > 0 && s_.unknowns[i].kappa < 0) add_sigma(s_.system, i, {.kappa = *part.kappa}, first_, S);
    put(0, 0, S);
    const Matrix I = Matrix::Identity(part.Abar.rows(), part.Abar.rows());
    put(0, above_[i], s_.options.pmin * I);
    if (!below_.empty()) put(0, below_[i], -*s_.options.pmax * I);
  }

  void unknown_part(std::size_t i, int unknown, const Parts& unit) {
    const ErrorPart& part = s_.system.parts[i];
    Matrix S = Matrix::Zero(first_.back(), first_.back());
    add_sigma(s_.system, i, unit, first_, S);
    put(unknown + 1, 0, -S);
    if (!slow_.empty()) {
      Matrix slow = lyapunov_part(part, unit);
      if (unit.P.size() > 0) slow += 2 * *s_.options.rmax * unit.P;
      put(unknown + 1, slow_[i], slow);
    }
    if (!bounded_.empty()) put(unknown + 1, bounded_[i], norm_bound(part, unit));
  }

  /// [nu I, W'; W, P], without nu.
  static Matrix norm_bound(const ErrorPart& part, const Parts& unit) {
    const auto p = part.Cbar.rows(), size = part.Abar.rows();
    Matrix bound = Matrix::Zero(p + size, p + size);
    if (unit.W.size() > 0) {
      bound.topRightCorner(p, size) = unit.W.transpose();
      bound.bottomLeftCorner(size, p) = unit.W;
    }
    if (unit.P.size() > 0) bound.bottomRightCorner(size, size) = unit.P;
    return bound;
  }

  void unknowns_of_p(std::size_t i) {
    const auto places = places_of_p(s_, i);
    const auto size = s_.system.parts[i].Abar.rows();
    for (std::size_t k = 0; k < places.size(); ++k) {
      const auto [row, column] = places[k];
      Parts unit{.P = Matrix::Zero(size, size)};
      unit.P(row, column) = unit.P(column, row) = 1;
      if (!s_.given.empty()) unit.W = unit.P * s_.given[i];
      const int unknown = s_.unknowns[i].P + static_cast<int>(k);
      unknown_part(i, unknown, unit);
      put(unknown + 1, above_[i], unit.P);
      if (!below_.empty()) put(unknown + 1, below_[i], -unit.P);
    }
  }

  void unknowns_of_w(std::size_t i) {
    const ErrorPart& part = s_.system.parts[i];
    const int rows = classical(s_) ? upper_rows(part) : static_cast<int>(part.Abar.rows());
    int unknown = s_.unknowns[i].W;
    for (Eigen::Index column = 0; column < part.Cbar.rows(); ++column) {
      for (int row = 0; row < rows; ++row) {
        Parts unit{.W = Matrix::Zero(part.Abar.rows(), part.Cbar.rows())};
        unit.W(row, column) = 1;
        unknown_part(i, unknown++, unit);
      }
    }
  }

  void scalar(std::size_t i, int unknown, double price, const Parts& unit) {
    if (unknown < 0) return;
    Matrix S = Matrix::Zero(first_.back(), first_.back());
    add_sigma(s_.system, i, unit, first_, S);
    put(unknown + 1, 0, -S);
    problem_.cost[static_cast<std::size_t>(unknown)] = price;
  }

  void scalars(std::size_t i) {
    const ErrorPart& part = s_.system.parts[i];
    const Unknowns& at = s_.unknowns[i];
    scalar(i, at.gd2, s_.options.cd, {.gd2 = 1});
    scalar(i, at.gw2, s_.options.cw, {.gw2 = 1});
    scalar(i, at.kappa, 0, {.kappa = 1});
    if (at.nu < 0) return;
    // L scales with 1/mu, so nu with 1/mu^2: the price keeps mu without effect.
    problem_.cost[static_cast<std::size_t>(at.nu)] = s_.options.cnu * part.mu * part.mu;
    Matrix identity = Matrix::Zero(part.Cbar.rows() + part.Abar.rows(), part.Cbar.rows() + part.Abar.rows());
    identity.diagonal().head(part.Cbar.rows()).setOnes();
    put(at.nu + 1, bounded_[i], identity);
  }

  Synthesis& s_;
  SdpProblem& problem_;
  std::vector<int> first_;                           ///< of every subsystem's rows in Sigma, and the end
  std::vector<int> above_, below_, bounded_, slow_;  ///< blocks, one a subsystem, or none at all
};

Synthesis build(const ErrorSystem& system, const SynthesisOptions& options, const Gains& given) {
  Synthesis synthesis{.system = system, .options = options, .given = given};
  lay_out(synthesis);
  Builder(synthesis).run();
  return synthesis;
}

}  // namespace

SynthesisOptions ref() { return {}; }

SynthesisOptions fast() { return {.pmax = 1e6, .cnu = 1e-9, .cd = 10, .cw = 1e4, .rmax = 1000}; }

SynthesisOptions matched() { return {.cnu = 1e-3}; }

Synthesis theorem_1(const ErrorSystem& system, const SynthesisOptions& options) { return build(system, options, {}); }

Synthesis certification(const ErrorSystem& system, const Gains& gains, const CertificationOptions& options) {
  return build(system, {.pmin = options.pmin.value_or(0), .pmax = options.pmax, .cd = 1, .cw = 1, .eps = options.eps},
               gains);
}

std::vector<std::string> block_names(const Synthesis& synthesis) {
  std::vector<std::string> names{"Sigma"};
  const auto each = [&](const char* what) {
    for (std::size_t i = 0; i < synthesis.system.parts.size(); ++i)
      names.push_back(fmt::format(fmt::runtime(what), i + 1));
  };
  each("P of {} above pmin");
  if (synthesis.options.pmax) each("P of {} below pmax");
  if (synthesis.given.empty()) each("L of {} bounded");
  if (synthesis.options.rmax) each("poles of {} slower than rmax");
  return names;
}

std::vector<std::pair<int, int>> places_of_p(const Synthesis& synthesis, std::size_t i) {
  const ErrorPart& part = synthesis.system.parts[i];
  const int size = static_cast<int>(part.Abar.rows());
  std::vector<std::pair<int, int>> places;
  const auto block = [&](int from, int to) {
    for (int column = from; column < to; ++column) {
      for (int row = column; row < to; ++row) places.emplace_back(row, column);
    }
  };
  block(0, classical(synthesis) ? upper_rows(part) : size);
  if (classical(synthesis)) block(upper_rows(part), size);
  return places;
}

std::optional<Design> read_design(const Synthesis& synthesis, const Eigen::VectorXd& y) {
  if (y.size() != synthesis.problem.variables() || !y.allFinite()) return std::nullopt;
  const auto root_at = [&](int at) { return at < 0 ? 0 : std::sqrt(std::max(0.0, y[at])); };
  Design design;
  design.objective = objective(synthesis.problem, y);
  for (std::size_t i = 0; i < synthesis.system.parts.size(); ++i) {
    const ErrorPart& part = synthesis.system.parts[i];
    const Unknowns& at = synthesis.unknowns[i];
    Matrix P = Matrix::Zero(part.Abar.rows(), part.Abar.rows());
    int unknown = at.P;
    for (const auto& [row, column] : places_of_p(synthesis, i)) P(row, column) = P(column, row) = y[unknown++];
    const Eigen::LLT<Matrix> factor(P);
    if (factor.info() != Eigen::Success) return std::nullopt;
    Matrix L = Matrix::Zero(part.Abar.rows(), part.Cbar.rows());
    if (at.W >= 0) {
      const auto rows = classical(synthesis) ? upper_rows(part) : part.Abar.rows();
      L.topRows(rows) = Eigen::Map<const Matrix>(y.data() + at.W, rows, part.Cbar.rows());
      factor.solveInPlace(L);
    } else {
      L = synthesis.given[i];
    }
    design.L.push_back(L);
    design.P.push_back(P);
    design.gamma_d.push_back(root_at(at.gd2));
    design.gamma_w.push_back(root_at(at.gw2));
    design.kappa.push_back(part.Fbar.cols() == 0 ? 0 : at.kappa >= 0 ? y[at.kappa] : *part.kappa);
  }
  return design;
}

}  // namespace vigil::observer
