#include <fmt/format.h>

#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>

#include "engine/linalg/care.hpp"
#include "engine/world/interconnected/network.hpp"

namespace vigil::observer {
namespace {

constexpr double kRank = 1e-10;  // of columns of length 1

/// Of a matrix with at least as many rows as columns.
double least_singular_value(const Eigen::MatrixXd& M) {
  return Eigen::JacobiSVD<Eigen::MatrixXd>(M).singularValues()[M.cols() - 1];
}

/// Whatever the columns' units.
bool full_column_rank(Eigen::MatrixXd M) {
  if (M.cols() == 0) return true;
  if (M.cols() > M.rows()) return false;
  for (auto column : M.colwise()) {
    const double length = column.norm();
    if (!(length > 0)) return false;
    column /= length;
  }
  return least_singular_value(M) > kRank;
}

/// Collects what is wrong with one subsystem.
class Check {
 public:
  Check(const Network& network, int index, std::vector<NetworkProblem>& problems)
      : s_(network.subsystems[static_cast<std::size_t>(index)]), index_(index), problems_(problems) {}

  void run() {
    const auto before = problems_.size();
    shapes();
    if (problems_.size() > before) return;  // ranks of the wrong shapes say nothing
    parameters();
    ranks();
    if (problems_.size() == before) detectability();
  }

 private:
  void say(const char* matrix, const std::string& reason) {
    const std::string name = s_.name.empty() ? std::to_string(index_ + 1) : s_.name;
    problems_.push_back({matrix, index_, fmt::format("subsystem {}: {}", name, reason)});
  }

  void matrix(const char* name, const Eigen::MatrixXd& M, int rows, int columns, const char* meaning) {
    if (M.rows() != rows || (columns >= 0 && M.cols() != columns)) {
      const std::string wanted = columns < 0 ? std::to_string(rows) + " rows" : fmt::format("{} x {}", rows, columns);
      say(name, fmt::format("{} is {} x {}; {} were expected, {}", name, M.rows(), M.cols(), wanted, meaning));
    } else if (M.cols() > kMaxSize) {
      say(name, fmt::format("{} has {} columns; at most {} are allowed", name, M.cols(), kMaxSize));
    } else if (!M.allFinite()) {
      say(name, fmt::format("{} has an entry that is not finite", name));
    }
  }

  void shapes() {
    const int n = s_.n(), p = s_.p();
    if (n == 0) return say("A", "A is empty; at least one state was expected");
    if (n > kMaxSize) return say("A", fmt::format("A has {} rows; at most {} are allowed", n, kMaxSize));
    if (p == 0) return say("C", "C is empty; at least one output was expected");
    if (p > kMaxSize) return say("C", fmt::format("C has {} rows; at most {} are allowed", p, kMaxSize));
    matrix("A", s_.A, n, n, "square");
    matrix("C", s_.C, p, n, "a column for every state of A");
    matrix("B", s_.B, n, -1, "one for every state of A");
    matrix("F", s_.F, n, -1, "one for every state of A");
    matrix("D", s_.D, n, -1, "one for every state of A");
    matrix("Dd", s_.Dd, n, -1, "one for every state of A");
    matrix("G", s_.G, p, -1, "one for every output of C");
    matrix("E", s_.E, p, p, "a row and a column for every output of C");
  }

  void parameters() {
    if (!std::isfinite(s_.alpha)) say("alpha", "alpha is not finite");
    if (!(std::isfinite(s_.tau) && s_.tau >= 0)) {
      say("tau", fmt::format("tau is {}; a finite number of at least 0 was expected", s_.tau));
    }
    if (s_.kappa && !(std::isfinite(*s_.kappa) && *s_.kappa > 0)) {
      say("kappa", fmt::format("kappa is {}; a finite number above 0, or none, was expected", *s_.kappa));
    }
    if (!(std::isfinite(s_.mu) && s_.mu > 0)) {
      say("mu", fmt::format("mu is {}; a finite number above 0 was expected", s_.mu));
    }
    if (!(std::isfinite(s_.varsigma) && s_.varsigma >= 0)) {
      say("varsigma", fmt::format("varsigma is {}; a finite number of at least 0 was expected", s_.varsigma));
    }
  }

  void ranks() {
    if (!full_column_rank(s_.D)) {
      say("D", "the columns of D are linearly dependent: two attacks that no output can tell apart");
    }
    if (!full_column_rank(s_.G)) {
      say("G", "the columns of G are linearly dependent: two faults that no output can tell apart");
    } else if (s_.g() == s_.p()) {
      say("G",
          fmt::format("G has as many faults as there are outputs, {}: nothing is left to see an attack by", s_.g()));
    }
    if (!full_column_rank(s_.C.transpose())) {
      say("C", "the rows of C are linearly dependent: an output that says nothing new");
    }
    if (!full_column_rank(s_.E)) say("E", "E is singular");
  }

  /// Of ([A2 D2; 0 0], [C1 0]), on the plant's own matrices: what the faults leave of the outputs sees every mode that
  /// does not decay, and every constant attack. Specification, section 1.
  void detectability() {
    const int n = s_.n(), p = s_.p();
    // Outputs in units of their own rows: what is rounding beside a row of C is rounding after the projection, too.
    const Eigen::VectorXd units = s_.C.rowwise().norm().cwiseInverse();
    const Eigen::MatrixXd C = units.asDiagonal() * s_.C, G = units.asDiagonal() * s_.G;
    Eigen::MatrixXd clean = Eigen::MatrixXd::Identity(p, p);
    if (s_.g() > 0) clean -= G * (G.transpose() * G).ldlt().solve(G.transpose());
    const Eigen::MatrixXd seen = clean * C;
    if (!detectable_continuous(s_.A, seen)) {
      return say("C", "not observable: invariant zero, a mode of A that does not decay is missing from the outputs");
    }
    const double size = s_.A.norm() > 0 ? s_.A.norm() : 1;
    Eigen::MatrixXd pencil = Eigen::MatrixXd::Zero(n + p, n + s_.q());
    pencil.topLeftCorner(n, n) = s_.A / size;
    pencil.bottomLeftCorner(p, n) = seen;
    for (int j = 0; j < s_.q(); ++j) pencil.block(0, n + j, n, 1) = s_.D.col(j).normalized();
    if (n + s_.q() > n + p || !(least_singular_value(pencil) > kRank)) {
      say("D", "not observable: invariant zero at 0, a constant attack is missing from the outputs");
    }
  }

  const Subsystem& s_;
  int index_;
  std::vector<NetworkProblem>& problems_;
};

void check_coupling(const Network& network, const Coupling& one, std::vector<NetworkProblem>& problems) {
  const std::string name = fmt::format("H_{}{}{}", one.to + 1, network.count() > 9 ? "_" : "", one.from + 1);
  const auto say = [&](const std::string& reason) { problems.push_back({name, one.to, name + " " + reason}); };
  const auto known = [&](int index) { return index >= 0 && index < network.count(); };
  if (!known(one.to) || !known(one.from)) return say("couples a subsystem that does not exist");
  if (one.to == one.from) return say("couples a subsystem with itself: that belongs to A");
  const int rows = network.subsystems[static_cast<std::size_t>(one.to)].n();
  const int columns = network.subsystems[static_cast<std::size_t>(one.from)].n();
  if (one.H.rows() != rows || one.H.cols() != columns) {
    return say(fmt::format("is {} x {}; {} x {} was expected", one.H.rows(), one.H.cols(), rows, columns));
  }
  if (!one.H.allFinite()) return say("has an entry that is not finite");
  if (network.coupling(one.to, one.from) != &one.H) say("is given twice");
}

}  // namespace

std::vector<NetworkProblem> check(const Network& network) {
  std::vector<NetworkProblem> problems;
  if (network.count() == 0) problems.push_back({"", -1, "a network without subsystems"});
  if (network.count() > kMaxSize) {
    problems.push_back({"", -1, fmt::format("{} subsystems; at most {} are allowed", network.count(), kMaxSize)});
    return problems;
  }
  for (int i = 0; i < network.count(); ++i) Check(network, i, problems).run();
  for (const Coupling& one : network.couplings) check_coupling(network, one, problems);
  return problems;
}

}  // namespace vigil::observer
