#include "engine/methods/replay/mixed_update.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "engine/linalg/ellipsoid.hpp"

namespace vigil::replay {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kEnd = 1e-9;        // sigma comes no nearer to 0 or 1
constexpr double kMostZeta = 1e9;    // (1 - kEnd) / kEnd, but for the last digits
constexpr double kSingular = 4e-15;  // a pivot below this share of its diagonal entry is rounding
constexpr double kRank = 1e-12;      // of C
constexpr double kSettled = 1e-14;   // relative, of zeta
constexpr int kTrials = 120;         // plain halving needs 60

/// Cholesky's factor; false where the matrix is singular up to rounding.
bool factorise(Eigen::LLT<BoundedMatrix>& factor, const BoundedMatrix& S) {
  factor.compute(S);
  if (factor.info() != Eigen::Success) return false;
  for (Eigen::Index i = 0; i < S.rows(); ++i) {
    const double pivot = factor.matrixLLT()(i, i);
    if (!(pivot * pivot > kSingular * S(i, i))) return false;
  }
  return true;
}

/// F M F'.
BoundedMatrix through(const BoundedMatrix& F, const BoundedMatrix& M) {
  BoundedMatrix FM(F.rows(), M.cols()), all(F.rows(), F.rows());
  FM.noalias() = F * M;
  all.noalias() = FM * F.transpose();
  return all;
}

/// Twice the logarithm of what (22) makes of a zeta over that zeta; zero at the optimum, positive below it. Cut where a
/// trace vanishes.
double excess(const MixedUpdate::Point& point) {
  const double wanted = point.of_sensor / point.of_prediction, zeta = point.rest / point.sigma;
  if (std::isnan(wanted)) return 0;
  return std::clamp(std::log(wanted) - 2 * std::log(zeta), -1e3, 1e3);
}

}  // namespace

void time_update(const Eigen::MatrixXd& A, const Eigen::MatrixXd& P, const Eigen::MatrixXd& Mw, Bounds& bounds) {
  const BoundedMatrix small = A;
  bounds.Q = through(small, bounds.Q) + P;
  bounds.M = minimum_trace_sum(through(small, bounds.M), Mw);
  symmetrise(bounds.Q);
  symmetrise(bounds.M);
}

MixedUpdate::MixedUpdate(const Eigen::MatrixXd& C, const Eigen::MatrixXd& R, const Eigen::MatrixXd& Mv, double mu,
                         double zeta_max)
    : C_(C), R_(R), Mv_(Mv), mu_(mu), zeta_max_(zeta_max) {
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(C.rows(), C.cols());
  qr.setThreshold(kRank);
  qr.compute(C);
  injective_ = qr.rank() == C.cols();
  if (injective_ && C.rows() == C.cols()) inverse_ = C.inverse();
}

/// K and X from W and S. With C of rank n the system of n unknowns, X = (I + W C'S^-1 C)^-1: I - K C formed by
/// subtraction loses all digits where K comes near C^-1. Otherwise, or where S is singular, that of p.
bool MixedUpdate::solve(Point& point, const BoundedMatrix& W, const BoundedMatrix& S) const {
  const auto n = C_.cols();
  const BoundedMatrix WCt = W * C_.transpose();
  Eigen::LLT<BoundedMatrix> factor(S.rows());
  if (injective_ && factorise(factor, S)) {
    const BoundedMatrix WCtS = factor.solve(WCt.transpose()).transpose();
    const BoundedMatrix system = BoundedMatrix::Identity(n, n) + WCtS * C_;
    point.X = Eigen::PartialPivLU<BoundedMatrix>(system).inverse();
    point.K.noalias() = point.X * WCtS;
  } else {
    const BoundedMatrix innovation = C_ * WCt + S;
    if (!factorise(factor, innovation)) return false;
    point.K = factor.solve(WCt.transpose()).transpose();
    point.X = BoundedMatrix::Identity(n, n) - point.K * C_;
  }
  return point.K.allFinite() && point.X.allFinite();
}

std::optional<MixedUpdate::Point> MixedUpdate::at_zeta(double zeta, const BoundedMatrix& Qp,
                                                       const BoundedMatrix& Mp) const {
  Point point{.sigma = 1 / (1 + zeta), .rest = zeta / (1 + zeta)};
  const BoundedMatrix W = mu_ * Qp + (1 - mu_) / point.sigma * Mp;
  const BoundedMatrix S = mu_ * R_ + (1 - mu_) / point.rest * Mv_;
  point.K.resize(C_.cols(), C_.rows());
  if (!solve(point, W, S)) return std::nullopt;
  point.of_sensor = (point.K * Mv_).cwiseProduct(point.K).sum();
  point.of_prediction = (point.X * Mp).cwiseProduct(point.X).sum();
  return point;
}

std::optional<MixedUpdate::Point> MixedUpdate::at(double sigma, const BoundedMatrix& Qp,
                                                  const BoundedMatrix& Mp) const {
  return at_zeta((1 - sigma) / sigma, Qp, Mp);
}

/// The section's steps 1 and 2, and the first half of 3: one of the bounded parts does not count.
std::optional<MixedUpdate::Choice> MixedUpdate::choose(const BoundedMatrix& Qp, const BoundedMatrix& Mp) const {
  const bool sensor = Mv_.trace() > 0, prediction = Mp.trace() > 0;
  if (mu_ < 1 && sensor && prediction) return choose_within(Qp, Mp);
  double start = 1, reported = 1;
  if (mu_ < 1 && prediction) {
    start = 1 / kMostZeta;
    reported = 0;
  } else if (mu_ < 1 && sensor) {
    start = kMostZeta;
    reported = kInfinity;
  }
  const auto point = at_zeta(start, Qp, Mp);
  if (!point) return std::nullopt;
  return Choice{*point, reported};
}

/// Steps 3 to 5.
std::optional<MixedUpdate::Choice> MixedUpdate::choose_within(const BoundedMatrix& Qp, const BoundedMatrix& Mp) const {
  const double most = std::min(zeta_max_, kMostZeta);
  const auto low = at_zeta(most, Qp, Mp);
  if (!low) return std::nullopt;
  if (low->slope() >= 0) {
    if (std::isfinite(zeta_max_)) return Choice{*low, most, Corner::none, false};
    Choice corner{*low, kInfinity, Corner::infinite};
    corner.point.sigma = 0;
    if (inverse_.size() > 0) {
      corner.point.K = inverse_;
      corner.point.X.setZero();
    }
    return corner;
  }
  const auto high = at_zeta(1 / kMostZeta, Qp, Mp);
  if (!high) return std::nullopt;
  if (high->slope() <= 0) {
    Choice corner{*high, 0, Corner::zero};
    corner.point.sigma = 1;
    corner.point.K.setZero();
    corner.point.X.setIdentity();
    return corner;
  }
  return search(*low, *high, Qp, Mp);
}

/// The root of `excess` over log zeta by Chandrupatla's method (1997): inverse quadratic interpolation where it is
/// safe, else halving.
std::optional<MixedUpdate::Choice> MixedUpdate::search(const Point& low, const Point& high, const BoundedMatrix& Qp,
                                                       const BoundedMatrix& Mp) const {
  const auto logarithm = [](const Point& point) { return std::log(point.rest / point.sigma); };
  double a = logarithm(low), b = logarithm(high), fa = excess(low), fb = excess(high), c = a, fc = fa, t = 0.5;
  std::optional<Point> point;
  for (int trial = 0; trial < kTrials; ++trial) {
    const double x = a + t * (b - a);
    point = at_zeta(std::exp(x), Qp, Mp);
    if (!point) return std::nullopt;
    const double fx = excess(*point);
    if ((fx > 0) == (fa > 0)) {
      c = a, fc = fa;
    } else {
      c = b, fc = fb;
      b = a, fb = fa;
    }
    a = x, fa = fx;
    const double width = std::abs(b - a);
    if (fx == 0 || width <= kSettled) break;
    const double xi = (a - b) / (c - b), phi = (fa - fb) / (fc - fb);
    const bool safe = 1 - std::sqrt(1 - xi) < phi && phi < std::sqrt(xi);
    t = safe ? fa / (fb - fa) * (fc / (fb - fc)) + (c - a) / (b - a) * (fa / (fc - fa)) * (fb / (fc - fb)) : 0.5;
    const double margin = 0.5 * kSettled / width;
    t = std::clamp(t, margin, 1 - margin);
  }
  return Choice{*point, std::sqrt(point->of_sensor / point->of_prediction), Corner::none, false};
}

std::optional<GainChoice> MixedUpdate::update(const BoundedMatrix& Qp, const BoundedMatrix& Mp) const {
  const auto choice = choose(Qp, Mp);
  if (!choice) return std::nullopt;
  const Point& point = choice->point;
  GainChoice gain{point.K, point.sigma, choice->zeta, choice->corner};
  gain.Q = through(point.X, Qp) + through(point.K, R_);
  const BoundedMatrix prediction = through(point.X, Mp), sensor = through(point.K, Mv_);
  gain.M = choice->least_trace ? minimum_trace_sum(prediction, sensor)
                               : BoundedMatrix((1 + choice->zeta) * prediction + (1 + 1 / choice->zeta) * sensor);
  symmetrise(gain.Q);
  symmetrise(gain.M);
  if (!gain.K.allFinite() || !gain.Q.allFinite() || !gain.M.allFinite()) return std::nullopt;
  return gain;
}

}  // namespace vigil::replay
