#include "engine/world/noise.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/linalg/covariance.hpp"
#include "engine/linalg/small.hpp"

namespace vigil {
namespace {

/// Radians that the turning bounded noise moves in a tick: specification of seed 003, section 3.
constexpr double kTurn = 0.7;

std::size_t place(const std::vector<std::string>& names, std::string_view name) {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? 0 : static_cast<std::size_t>(found - names.begin());
}

}  // namespace

const std::vector<std::string>& law_names() {
  static const std::vector<std::string> names{"gauss", "gmix", "skewmix", "laplace", "gamma", "student"};
  return names;
}

const std::vector<std::string>& bounded_law_names() {
  static const std::vector<std::string> names{"uniform", "surface", "sine"};
  return names;
}

Words law_words(Law law) {
  switch (law) {
    case Law::gauss:
      return {"Normal", "正态分布"};
    case Law::gmix:
      return {"Normal with outliers: 0.9 N(0, 1) + 0.1 N(0, 25)", "含异常值的正态混合：0.9 N(0, 1) + 0.1 N(0, 25)"};
    case Law::skewmix:
      return {"Skewed mixture: 0.8 N(-0.5, 0.25) + 0.2 N(2, 1)", "偏斜混合：0.8 N(-0.5, 0.25) + 0.2 N(2, 1)"};
    case Law::laplace:
      return {"Laplace", "拉普拉斯分布"};
    case Law::gamma:
      return {"Centred gamma of shape 2", "形状参数为 2 的中心化伽马分布"};
    case Law::student:
      return {"Student's t with 5 degrees of freedom", "自由度为 5 的学生 t 分布"};
  }
  return {};
}

Law law_of(std::string_view name) { return static_cast<Law>(place(law_names(), name)); }
BoundedLaw bounded_law_of(std::string_view name) { return static_cast<BoundedLaw>(place(bounded_law_names(), name)); }

NoiseSource::NoiseSource(const Eigen::MatrixXd& covariance, Law law, const Eigen::MatrixXd& shape, BoundedLaw bounded,
                         std::uint64_t seed, const std::string& stream)
    : factor_(law == Law::gauss ? symmetric_root(covariance) : cholesky_factor(covariance)),
      shape_factor_(cholesky_factor(shape)),
      law_(law),
      bounded_(bounded),
      random_(!covariance.isZero(0)),
      has_bounded_(!shape.isZero(0)),
      draws_(seed, stream),
      branches_(seed, stream + ".branch"),
      directions_(seed, stream + ".bounded") {
  phase_ = 2 * std::numbers::pi * Draws(seed, stream + ".phase").uniform(0, 0);
}

double NoiseSource::standard(std::int64_t k, std::uint32_t index) const {
  switch (law_) {
    case Law::gauss:
      return draws_.normal(k, index);
    case Law::gmix:
      return draws_.mixture(k, index, 0.1, 1, 5) / std::sqrt(0.9 + 0.1 * 25);
    case Law::skewmix: {
      const double normal = draws_.normal(k, index);
      // Mean 0.8 (-0.5) + 0.2 (2) = 0; variance 0.8 (0.25 + 0.25) + 0.2 (1 + 4) = 1.4.
      return (branches_.bernoulli(k, index, 0.2) ? 2 + normal : -0.5 + 0.5 * normal) / std::sqrt(1.4);
    }
    case Law::laplace:
      return draws_.laplace(k, index, 1 / std::numbers::sqrt2);
    case Law::gamma:
      return (draws_.gamma(k, index, 2, 1) - 2) / std::numbers::sqrt2;
    case Law::student:
      return draws_.student(k, index, 5) / std::sqrt(5.0 / 3.0);
  }
  return 0;
}

void NoiseSource::add_bounded(std::int64_t k, Eigen::Ref<Eigen::VectorXd> out) const {
  BoundedVector direction(out.size());
  if (bounded_ == BoundedLaw::sine) {
    const double angle = kTurn * static_cast<double>(k) + phase_;
    direction.setZero();
    direction[0] = std::cos(angle);
    if (direction.size() > 1) direction[1] = std::sin(angle);
  } else {
    directions_.unit_ball(k, direction);
    if (bounded_ == BoundedLaw::surface) direction.normalize();
  }
  out.noalias() += shape_factor_ * direction;
}

void NoiseSource::draw(std::int64_t k, Eigen::Ref<Eigen::VectorXd> out) const {
  out.setZero();
  if (random_ && law_ == Law::gauss) {
    BoundedVector normals(out.size());
    draws_.normals(k, normals);
    out.noalias() += factor_ * normals;
  } else if (random_) {
    for (Eigen::Index c = 0; c < out.size(); ++c)
      out.noalias() += standard(k, static_cast<std::uint32_t>(c)) * factor_.col(c);
  }
  if (has_bounded_) add_bounded(k, out);
}

}  // namespace vigil
