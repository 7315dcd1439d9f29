#include "tests/engine/methods/sparse/references.hpp"

#include <algorithm>
#include <numeric>

namespace vigil::windows {

LiteralOmp literal_omp(const Eigen::MatrixXd& M, const Eigen::VectorXd& b, int picks, double eps,
                       const std::function<double(const Eigen::VectorXd& E)>& remaining) {
  LiteralOmp result{Eigen::VectorXd::Zero(b.size()), {}, 0};
  Eigen::VectorXd res = b;
  while (static_cast<int>(result.support.size()) < picks && remaining(result.E) > eps) {
    int best = -1;
    double most = -1;
    for (int j = 0; j < static_cast<int>(b.size()); ++j) {
      if (std::find(result.support.begin(), result.support.end(), j) != result.support.end()) continue;
      const double gain = std::abs(res[j]) / std::sqrt(std::max(M(j, j), 1e-12));
      if (gain > most) {
        most = gain;
        best = j;
      }
    }
    result.support.push_back(best);
    const Eigen::MatrixXd columns = M(Eigen::all, result.support);
    const Eigen::MatrixXd square = columns(result.support, Eigen::all);
    const Eigen::VectorXd right = b(result.support);
    const Eigen::VectorXd coefficients = square.fullPivHouseholderQr().solve(right);
    result.E.setZero();
    for (std::size_t i = 0; i < result.support.size(); ++i)
      result.E[result.support[i]] = coefficients[static_cast<Eigen::Index>(i)];
    res = b - columns * coefficients;
  }
  result.residual = remaining(result.E);
  return result;
}

Eigen::VectorXd literal_gradient(const Plain& w, int q, double nu, int most_steps, bool block) {
  const auto size = w.r.size();
  const int T = static_cast<int>(size) / 6;
  const auto project = [&](const Eigen::VectorXd& E) {
    std::vector<int> order(static_cast<std::size_t>(block ? 6 : size));
    std::iota(order.begin(), order.end(), 0);
    const auto energy = [&](int place) {
      double sum = 0;
      for (int i = place; i < (block ? size : place + 1); i += 6) sum += E[i] * E[i];
      return sum;
    };
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return energy(a) > energy(b); });
    Eigen::VectorXd kept = Eigen::VectorXd::Zero(size);
    for (int n = 0; n < std::min<int>(block ? q : q * T, static_cast<int>(order.size())); ++n) {
      for (int i = order[static_cast<std::size_t>(n)]; i < (block ? size : order[static_cast<std::size_t>(n)] + 1);
           i += 6)
        kept[i] = E[i];
    }
    return kept;
  };
  const double norm = Eigen::JacobiSVD<Eigen::MatrixXd>(w.Phi).singularValues()[0], eta = 1 / (norm * norm + 1);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(6), E = Eigen::VectorXd::Zero(size);
  double last = 0.5 * w.r.squaredNorm();
  int since_event = 0;
  for (int step = 0; step < most_steps; ++step) {
    const Eigen::VectorXd g = w.r - w.Phi * x - E;
    x += eta * w.Phi.transpose() * g;
    E += eta * g;
    const Eigen::VectorXd Ep = project(E);
    const double Vp = 0.5 * (w.r - w.Phi * x - Ep).squaredNorm();
    if (Vp <= (1 - nu) * last || ++since_event == 30) {
      E = Ep;
      last = Vp;
      since_event = 0;
    }
    if (last <= 1e-6) break;
  }
  return project(E);
}

LiteralChannels literal_channels(const Eigen::MatrixXd& M, const Eigen::VectorXd& r, int q, double eps) {
  const auto size = r.size();
  LiteralChannels best{Eigen::VectorXd::Zero(size), {}};
  if ((M * r).norm() <= eps) return best;
  for (int members = 1; members <= q; ++members) {
    double least = std::numeric_limits<double>::infinity();
    std::vector<std::vector<int>> sets;
    for (int mask = 0; mask < 64; ++mask) {
      std::vector<int> set;
      for (int c = 0; c < 6; ++c) {
        if ((mask >> c) % 2 == 1) set.push_back(c);
      }
      if (static_cast<int>(set.size()) == members) sets.push_back(set);
    }
    std::sort(sets.begin(), sets.end());
    for (const std::vector<int>& set : sets) {
      std::vector<int> places;
      for (int i = 0; i < size; ++i) {
        if (std::find(set.begin(), set.end(), i % 6) != set.end()) places.push_back(i);
      }
      const Eigen::MatrixXd A = M(Eigen::all, places);
      const Eigen::VectorXd entries = A.colPivHouseholderQr().solve(M * r);
      const double residual = (M * r - A * entries).norm();
      if (!(residual < least)) continue;
      least = residual;
      best.channels = set;
      best.E.setZero();
      for (std::size_t i = 0; i < places.size(); ++i) best.E[places[i]] = entries[static_cast<Eigen::Index>(i)];
    }
    if (least <= eps) break;
  }
  return best;
}

double least_l1(const Plain& w) {
  const int size = static_cast<int>(w.r.size());
  std::vector<int> rows{0, 1, 2, 3, 4, 5};
  double least = std::numeric_limits<double>::infinity();
  for (bool more = true; more;) {
    const Eigen::Matrix<double, 6, 6> square = w.Phi(rows, Eigen::all);
    const Eigen::Matrix<double, 6, 1> right = w.r(rows);
    const Eigen::PartialPivLU<Eigen::Matrix<double, 6, 6>> lu(square);
    if (std::abs(lu.determinant()) > 1e-12) least = std::min(least, (w.r - w.Phi * lu.solve(right)).lpNorm<1>());
    int i = 5;
    while (i >= 0 && rows[static_cast<std::size_t>(i)] == size - 6 + i) --i;
    more = i >= 0;
    if (!more) break;
    ++rows[static_cast<std::size_t>(i)];
    for (int j = i + 1; j < 6; ++j) rows[static_cast<std::size_t>(j)] = rows[static_cast<std::size_t>(j - 1)] + 1;
  }
  return least;
}

}  // namespace vigil::windows
