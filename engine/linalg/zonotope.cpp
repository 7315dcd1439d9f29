#include "engine/linalg/zonotope.hpp"

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace vigil {
namespace {

using Matrix = Eigen::Ref<const Eigen::MatrixXd>;
using Vector = Eigen::Ref<const Eigen::VectorXd>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kFlat = 1e-12;        // of the generators' size: no width at all
constexpr double kOffPlane = 1e-9;     // of the generators' size: outside a flat zonotope
constexpr double kSlack = 1e-9;        // of the verdict, specification, section 8.2, item 5
constexpr double kRounding = 1e-15;    // of a sum of weights
constexpr double kMultiplier = 1e-11;  // above its weight by less than this share is optimal
constexpr double kStanding = 1e-12;    // a rate below this never reaches zero, a distance below this is none

std::size_t at(Eigen::Index i) { return static_cast<std::size_t>(i); }

double share(double part, double whole) { return part == 0 ? 0 : (whole > 0 ? part / whole : kInfinity); }

/// The normals of a polygon's edges are at right angles to its generators; a flat one has two ends besides.
double ratio_in_plane(const Matrix& H, const Vector& z) {
  double size = 0, most = 0;
  for (Eigen::Index j = 0; j < H.cols(); ++j) size += std::hypot(H(0, j), H(1, j));
  if (size == 0) return share(z.cwiseAbs().maxCoeff(), 0);
  for (Eigen::Index j = 0; j < H.cols(); ++j) {
    const double length = std::hypot(H(0, j), H(1, j));
    if (length == 0) continue;
    const double n1 = -H(1, j) / length, n2 = H(0, j) / length;
    double across = 0, along = 0;
    for (Eigen::Index i = 0; i < H.cols(); ++i) {
      across += std::abs(n1 * H(0, i) + n2 * H(1, i));
      along += std::abs(n2 * H(0, i) - n1 * H(1, i));
    }
    const double distance = std::abs(n1 * z[0] + n2 * z[1]);
    if (across > kFlat * size) {
      most = std::max(most, distance / across);
    } else {
      if (distance > kOffPlane * std::max(size, std::hypot(z[0], z[1]))) return kInfinity;
      most = std::max(most, std::abs(n2 * z[0] - n1 * z[1]) / along);
    }
  }
  return most;
}

/// The least sum_j w_j |u_j'y| among all y with z'y = 1, for unit vectors u_j that span the space: half the width of a
/// zonotope along its tightest normal. Simplex steps from vertex to vertex, each the exact minimum along its edge. A
/// vertex holds p - 1 generators with u_j'y = 0; all others have a side.
class TightestNormal {
 public:
  TightestNormal(const Eigen::MatrixXd& H, const Eigen::VectorXd& z);
  double solve();

 private:
  /// Who leaves the vertex, towards which side.
  struct Edge {
    Eigen::Index place = -1;
    double side = 1;
  };
  void evaluate();
  Edge leaving(bool bland) const;
  bool move(const Edge& edge, bool bland);
  Eigen::Index variable(Eigen::Index j) const { return 2 * j + (side_[j] < 0 ? 1 : 0); }

  Eigen::MatrixXd u_, corner_;  ///< p x generators; the vertex' generators and z
  Eigen::VectorXd w_, z_;
  Eigen::VectorXd side_;  ///< +1 or -1; of a vertex' generator: 0
  std::vector<Eigen::Index> vertex_;
  Eigen::MatrixXd inverse_;      ///< of corner_
  Eigen::VectorXd y_, reach_;    ///< reach_: u'y
  Eigen::VectorXd multipliers_;  ///< of the vertex' generators, and last the value
  bool stood_ = false;           ///< the last step had no length
};

TightestNormal::TightestNormal(const Eigen::MatrixXd& H, const Eigen::VectorXd& z)
    : u_(H.colwise().normalized()), corner_(H.rows(), H.rows()), w_(H.colwise().norm().transpose()), z_(z) {
  const auto p = H.rows();
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(u_ - z_ * (z_.transpose() * u_));
  for (Eigen::Index i = 0; i + 1 < p; ++i) vertex_.push_back(qr.colsPermutation().indices()[i]);
  side_ = Eigen::VectorXd::Ones(H.cols());
  evaluate();
  for (Eigen::Index j = 0; j < H.cols(); ++j) side_[j] = reach_[j] < 0 ? -1 : 1;
  for (const auto j : vertex_) side_[j] = 0;
  evaluate();
}

void TightestNormal::evaluate() {
  const auto last = u_.rows() - 1;
  for (Eigen::Index i = 0; i < last; ++i) corner_.col(i) = u_.col(vertex_[at(i)]);
  corner_.col(last) = z_;
  inverse_ = corner_.inverse();
  y_ = inverse_.row(last);
  reach_ = u_.transpose() * y_;
  multipliers_ = inverse_ * (u_ * side_.cwiseProduct(w_));
}

/// A generator whose multiplier exceeds its weight may leave: the one that lowers the sum fastest, or by Bland's rule
/// the first.
TightestNormal::Edge TightestNormal::leaving(bool bland) const {
  Edge best;
  double most = 0;
  for (Eigen::Index i = 0; i + 1 < u_.rows(); ++i) {
    const auto j = vertex_[at(i)];
    const double excess = std::abs(multipliers_[i]) - w_[j];
    if (excess <= kMultiplier * w_[j] + kRounding * inverse_.row(i).norm() * w_.sum()) continue;
    if (best.place >= 0 && (bland ? j > vertex_[at(best.place)] : excess <= most)) continue;
    best = {i, multipliers_[i] > 0 ? -1.0 : 1.0};
    most = excess;
  }
  return best;
}

/// Along the edge the sum falls until enough generators have changed sides. False where rounding hides all of them.
bool TightestNormal::move(const Edge& edge, bool bland) {
  const auto gone = vertex_[at(edge.place)];
  const Eigen::VectorXd way = inverse_.row(edge.place).transpose() * edge.side;
  const Eigen::VectorXd rates = u_.transpose() * way;
  struct Crossing {
    double step;
    Eigen::Index j;
  };
  std::vector<Crossing> crossings;
  for (Eigen::Index j = 0; j < u_.cols(); ++j) {
    const double rate = -side_[j] * rates[j], distance = side_[j] * reach_[j];
    if (rate <= kStanding * way.norm()) continue;
    crossings.push_back({distance > kStanding * y_.norm() ? distance / rate : 0, j});
  }
  if (crossings.empty()) return false;
  std::sort(crossings.begin(), crossings.end(), [&](const Crossing& a, const Crossing& b) {
    return a.step != b.step ? a.step < b.step : variable(a.j) < variable(b.j);
  });
  double slope = w_[gone] - std::abs(multipliers_[edge.place]);
  std::size_t reached = 0;
  for (; !bland && reached + 1 < crossings.size(); ++reached) {
    const auto j = crossings[reached].j;
    slope += 2 * w_[j] * std::abs(rates[j]);
    if (slope >= 0) break;
    side_[j] = -side_[j];
  }
  stood_ = crossings[reached].step == 0;
  side_[gone] = edge.side;
  vertex_[at(edge.place)] = crossings[reached].j;
  side_[crossings[reached].j] = 0;
  return true;
}

double TightestNormal::solve() {
  const auto most = 100 + 20 * u_.cols();
  Eigen::Index standing = 0;  // steps in a row without length; Bland's rule ends them
  for (Eigen::Index step = 0; step < most; ++step) {
    const bool bland = standing > u_.rows();
    const Edge edge = leaving(bland);
    if (edge.place < 0 || !move(edge, bland)) break;
    standing = stood_ ? standing + 1 : 0;
    evaluate();
  }
  return reach_.cwiseAbs().dot(w_);  // of a true normal at any step: never too small a ratio is claimed
}

/// In the generators' own span, where it is smaller than the space.
double ratio_beyond(const Matrix& H, const Vector& z) {
  const double size = H.cwiseAbs().maxCoeff();
  if (size == 0) return kInfinity;
  const Eigen::VectorXd point = z / size;
  if (!point.allFinite()) return kInfinity;
  Eigen::MatrixXd generators(H.rows(), H.cols());
  Eigen::Index kept = 0;
  for (Eigen::Index j = 0; j < H.cols(); ++j) {
    generators.col(kept) = H.col(j) / size;
    if (generators.col(kept).norm() > 0) ++kept;
  }
  generators.conservativeResize(Eigen::NoChange, kept);
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(H.rows(), kept);
  qr.setThreshold(kFlat);
  qr.compute(generators);
  const auto rank = qr.rank();
  if (rank < H.rows()) {
    const Eigen::MatrixXd span = Eigen::MatrixXd(qr.householderQ()).leftCols(rank);
    const Eigen::VectorXd inside = span.transpose() * point;
    if ((point - span * inside).norm() > kOffPlane * std::max(1.0, point.norm())) return kInfinity;
    return ratio(span.transpose() * generators, inside);
  }
  const double length = point.stableNorm();
  return length / TightestNormal(generators, point / length).solve();
}

}  // namespace

Eigen::Index reduce(const Eigen::Ref<const Eigen::MatrixXd>& H, int order, Eigen::MatrixXd& reduced,
                    std::vector<Eigen::Index>& places) {
  const auto p = H.rows();
  if (H.cols() <= std::max<Eigen::Index>(order, p)) {
    reduced.leftCols(H.cols()) = H;
    return H.cols();
  }
  places.resize(at(H.cols()));
  std::iota(places.begin(), places.end(), Eigen::Index{0});
  std::sort(places.begin(), places.end(), [&](Eigen::Index a, Eigen::Index b) {
    const double of_a = H.col(a).norm(), of_b = H.col(b).norm();
    return of_a != of_b ? of_a > of_b : a < b;
  });
  const auto kept = std::max<Eigen::Index>(order - p, 0);
  auto box = reduced.middleCols(kept, p);
  box.setZero();
  for (Eigen::Index j = 0; j < H.cols(); ++j) {
    const auto column = H.col(places[at(j)]);
    if (j < kept) {
      reduced.col(j) = column;
    } else {
      box.diagonal() += column.cwiseAbs();
    }
  }
  return kept + p;
}

Eigen::MatrixXd reduce(const Eigen::Ref<const Eigen::MatrixXd>& H, int order) {
  Eigen::MatrixXd reduced(H.rows(), std::max<Eigen::Index>(order, H.rows()));
  std::vector<Eigen::Index> places;
  const auto count = reduce(H, order, reduced, places);
  return reduced.leftCols(count);
}

Eigen::VectorXd half_widths(const Eigen::Ref<const Eigen::MatrixXd>& H) { return H.cwiseAbs().rowwise().sum(); }

double ratio(const Eigen::Ref<const Eigen::MatrixXd>& H, const Eigen::Ref<const Eigen::VectorXd>& z) {
  if (!H.allFinite() || !z.allFinite()) return std::numeric_limits<double>::quiet_NaN();
  if ((z.array() == 0).all()) return 0;
  if (H.cols() == 0) return kInfinity;
  if (z.size() == 1) return share(std::abs(z[0]), H.cwiseAbs().sum());
  if (z.size() == 2) return ratio_in_plane(H, z);
  return ratio_beyond(H, z);
}

bool contains(const Eigen::Ref<const Eigen::MatrixXd>& H, const Eigen::Ref<const Eigen::VectorXd>& z) {
  const double scale = ratio(H, z);
  return scale <= (z.size() == 1 ? 1 : 1 + kSlack);
}

}  // namespace vigil
