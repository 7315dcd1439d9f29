#include "engine/random/draws.hpp"

#include <cmath>
#include <numbers>
#include <utility>

namespace vigil {
namespace {

constexpr std::uint64_t split_mix(std::uint64_t z) {
  z += 0x9e3779b97f4a7c15U;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31);
}

constexpr std::uint32_t fnv1a(std::string_view text) {
  std::uint32_t hash = 2166136261U;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619U;
  return hash;
}

double to_unit(std::uint32_t high, std::uint32_t low) {
  return static_cast<double>((std::uint64_t{high} << 32 | low) >> 11) * 0x1.0p-53;
}

/// Two independent standard normals from one block.
std::pair<double, double> box_muller(const PhiloxBlock& bits) {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - to_unit(bits[0], bits[1])));
  const double angle = 2.0 * std::numbers::pi * to_unit(bits[2], bits[3]);
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

// Laws that need more than one number of a draw use these sub-counters, so that no two of them share bits.
constexpr std::uint32_t kNormal = 1;
constexpr std::uint32_t kBall = 2;
constexpr std::uint32_t kGammaBoost = 3;
constexpr std::uint32_t kGammaTries = 4;

}  // namespace

Draws::Draws(std::uint64_t seed, std::string_view stream) : name_(fnv1a(stream)) {
  const std::uint64_t mixed = split_mix(seed);
  key_ = {static_cast<std::uint32_t>(mixed), static_cast<std::uint32_t>(mixed >> 32)};
}

PhiloxBlock Draws::block(std::int64_t tick, std::uint32_t index, std::uint32_t sub) const {
  const auto address = static_cast<std::uint64_t>(tick);
  return philox(
      {static_cast<std::uint32_t>(address), name_, index, static_cast<std::uint32_t>(address >> 32 << 16) | sub}, key_);
}

double Draws::uniform(std::int64_t tick, std::uint32_t index) const {
  const PhiloxBlock bits = block(tick, index);
  return to_unit(bits[0], bits[1]);
}

bool Draws::bernoulli(std::int64_t tick, std::uint32_t index, double probability) const {
  return uniform(tick, index) < probability;
}

double Draws::normal_at(std::int64_t tick, std::uint32_t index, std::uint32_t sub) const {
  const auto pair = box_muller(block(tick, index / 2, sub));
  return index % 2 == 0 ? pair.first : pair.second;
}

double Draws::normal(std::int64_t tick, std::uint32_t index) const { return normal_at(tick, index, kNormal); }

void Draws::normals(std::int64_t tick, Eigen::Ref<Eigen::VectorXd> out) const {
  for (Eigen::Index i = 0; i < out.size(); i += 2) {
    const auto pair = box_muller(block(tick, static_cast<std::uint32_t>(i / 2), kNormal));
    out[i] = pair.first;
    if (i + 1 < out.size()) out[i + 1] = pair.second;
  }
}

double Draws::laplace(std::int64_t tick, std::uint32_t index, double scale) const {
  const double centred = uniform(tick, index) - 0.5;
  const double tail = -scale * std::log1p(-2.0 * std::abs(centred));
  return std::copysign(tail, centred);
}

double Draws::gamma(std::int64_t tick, std::uint32_t index, double shape, double scale) const {
  if (shape < 1.0) {
    const PhiloxBlock bits = block(tick, index, kGammaBoost);
    return gamma(tick, index, shape + 1.0, scale) * std::pow(1.0 - to_unit(bits[0], bits[1]), 1.0 / shape);
  }
  const double d = shape - 1.0 / 3.0;
  const double c = 1.0 / std::sqrt(9.0 * d);
  for (std::uint32_t attempt = kGammaTries;; attempt += 2) {
    const double x = box_muller(block(tick, index, attempt)).first;
    const double root = 1.0 + c * x;
    if (root <= 0) continue;
    const double v = root * root * root;
    const PhiloxBlock bits = block(tick, index, attempt + 1);
    const double u = 1.0 - to_unit(bits[0], bits[1]);
    if (std::log(u) < 0.5 * x * x + d - d * v + d * std::log(v)) return d * v * scale;
  }
}

double Draws::student(std::int64_t tick, std::uint32_t index, double degrees) const {
  const double chi_square = gamma(tick, index, degrees / 2.0, 2.0);
  return normal(tick, index) / std::sqrt(chi_square / degrees);
}

double Draws::mixture(std::int64_t tick, std::uint32_t index, double share, double nominal, double outlier) const {
  return normal(tick, index) * (bernoulli(tick, index, share) ? outlier : nominal);
}

void Draws::unit_ball(std::int64_t tick, Eigen::Ref<Eigen::VectorXd> out) const {
  normals(tick, out);
  const PhiloxBlock bits = block(tick, 0, kBall);
  const double radius = std::pow(to_unit(bits[0], bits[1]), 1.0 / static_cast<double>(out.size()));
  out *= radius / out.norm();
}

}  // namespace vigil
