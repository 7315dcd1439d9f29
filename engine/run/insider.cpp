#include "engine/run/insider.hpp"

#include <Eigen/Cholesky>
#include <cmath>

namespace vigil {
namespace {

void wrap_reading(const Sensor& sensor, Eigen::Ref<Eigen::VectorXd> reading) {
  for (Eigen::Index c = 0; c < reading.size(); ++c)
    reading[c] = wrap(reading[c], sensor.channels()[static_cast<std::size_t>(c)].period);
}

/// R and what the bounded part adds to it: uniform in {v : v' M^-1 v <= 1} of p dimensions it has covariance M/(p+2).
BoundedMatrix noise_of(const Sensor& sensor) {
  return sensor.noise() + sensor.bounded_noise() / (static_cast<double>(sensor.size()) + 2);
}

}  // namespace

void Insider::move(const World& world, const Course& course, int node, const Shaping& how,
                   Eigen::Ref<Eigen::VectorXd> reading) {
  const Sensor& sensor = *world.sensors[static_cast<std::size_t>(node)];
  if (sensor.linear()) {
    BoundedMatrix H(sensor.size(), course.truth.size());
    sensor.jacobian(Eigen::VectorXd::Zero(course.truth.size()), H);
    reading.noalias() += how.share * (H * *how.moved);
    return wrap_reading(sensor, reading);
  }
  if (!course.truth.allFinite()) return;
  BoundedVector here(sensor.size()), there(sensor.size());
  const BoundedVector off = course.truth + how.share * *how.moved;
  sensor.measure(course.truth, here);
  sensor.measure(off, there);
  reading += there - here;
  wrap_reading(sensor, reading);
}

void Insider::predict(const World& world, const Course& course, bool fresh, Filter& filter) {
  const Eigen::Index n = course.truth.size();
  if (fresh) {
    filter.x = course.truth;
    filter.P = world.process_covariance;
    return;
  }
  BoundedMatrix F(n, n);
  BoundedVector next(n);
  world.plant->jacobian(filter.x, course.input, F);
  world.plant->advance(filter.x, course.input, next);
  filter.x = next;
  const BoundedMatrix spread = F * filter.P;
  filter.P = spread * F.transpose() + world.process_covariance;
}

void Insider::shape(std::int64_t k, const World& world, const Course& course, int node, const Shaping& how,
                    Eigen::Ref<Eigen::VectorXd> reading) {
  if (how.moved != nullptr) move(world, course, node, how, reading);
  if (how.direction == nullptr) return;
  if (filters_.empty()) filters_.resize(world.sensors.size());
  Filter& filter = filters_[static_cast<std::size_t>(node)];
  const bool fresh = filter.k != k - 1;
  if (fresh && !course.truth.allFinite()) return;
  predict(world, course, fresh, filter);
  const Sensor& sensor = *world.sensors[static_cast<std::size_t>(node)];
  const Eigen::Index p = sensor.size(), n = course.truth.size();
  BoundedMatrix H(p, n);
  sensor.jacobian(filter.x, H);
  const BoundedMatrix cross = filter.P * H.transpose();
  const BoundedMatrix S = H * cross + noise_of(sensor);
  const Eigen::LLT<BoundedMatrix> root(S);
  if (root.info() != Eigen::Success || !filter.x.allFinite()) return;
  filter.k = k;
  const BoundedMatrix L = root.matrixL();
  const BoundedVector innovation = std::sqrt(how.budget) * (L * *how.direction);
  BoundedVector expected(p);
  sensor.measure(filter.x, expected);
  reading = expected + innovation;
  wrap_reading(sensor, reading);
  filter.x += cross * root.solve(innovation);
  const BoundedMatrix gained = cross * root.solve(BoundedMatrix(cross.transpose()));
  filter.P -= gained;
  symmetrise(filter.P);
}

}  // namespace vigil
