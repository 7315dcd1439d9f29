#include "tests/engine/methods/observer/networks.hpp"

namespace vigil::observer {

Subsystem random_subsystem(RandomMatrices& random, const Sizes& sizes) {
  Subsystem s;
  s.A = random.gaussian(sizes.n, sizes.n) - 3 * Eigen::MatrixXd::Identity(sizes.n, sizes.n);
  s.B = random.gaussian(sizes.n, sizes.m);
  s.C = random.gaussian(sizes.p, sizes.n);
  s.D = random.gaussian(sizes.n, sizes.q);
  s.Dd = random.gaussian(sizes.n, sizes.dd);
  s.G = random.gaussian(sizes.p, sizes.g);
  s.F = random.gaussian(sizes.n, sizes.r);
  s.E = random.gaussian(sizes.p, sizes.p) + 3 * Eigen::MatrixXd::Identity(sizes.p, sizes.p);
  s.tau = 0.3 * random.uniform();
  s.alpha = 0.2 * random.normal();
  s.varsigma = random.log_uniform(0.3, 3);
  s.mu = random.log_uniform(0.5, 2);
  return s;
}

Network mixed(int number) {
  RandomMatrices random(number);
  Network network;
  network.subsystems = {random_subsystem(random, {3, 1, 3, 2, 1, 1, 1}),
                        random_subsystem(random, {2, 0, 1, 0, 0, 0, 0}),
                        random_subsystem(random, {4, 2, 3, 1, 2, 0, 2})};
  for (const auto& [to, from] : {std::pair{1, 0}, {2, 1}, {0, 2}}) {
    const auto& s = network.subsystems;
    network.couplings.push_back(
        {to, from, random.gaussian(s[static_cast<std::size_t>(to)].n(), s[static_cast<std::size_t>(from)].n())});
  }
  return network;
}

bool run_lane(NetworkSimulation simulation, const Example& example, const Watch& watch, int finer) {
  Eigen::VectorXd state = simulation.initial(example.x0), inputs(simulation.inputs());
  const int steps = finer * steps_per_tick(example.dt, simulation.fastest());
  const auto ticks = std::lround(example.horizon / example.dt);
  for (long tick = 0; tick < ticks; ++tick) {
    if (!simulation.advance(state, static_cast<double>(tick) * example.dt, example.dt, steps, example.signals))
      return false;
    const double t = static_cast<double>(tick + 1) * example.dt;
    simulation.read_inputs(example.signals, t, t, inputs);
    for (int i = 0; i < example.network.count(); ++i) watch(t, i, simulation.snapshot(i, state, inputs));
  }
  return true;
}

std::vector<Score> score(const NetworkSimulation& simulation, const Example& example, double from, double to) {
  const auto count = static_cast<std::size_t>(example.network.count());
  std::vector<Score> sums(count);
  std::vector<Eigen::VectorXd> squares(count);
  double ticks = 0;
  const bool ended = run_lane(simulation, example, [&](double t, int index, const Snapshot& s) {
    if (t <= from + 1e-9 || t > to + 1e-9) return;
    const auto i = static_cast<std::size_t>(index);
    if (i == 0) ++ticks;
    if (squares[i].size() == 0) squares[i] = Eigen::VectorXd::Zero(s.x.size());
    sums[i].w += (s.w - s.what).squaredNorm();
    sums[i].signal_w += s.w.squaredNorm();
    if (s.fhat.size() > 0) sums[i].f += (s.f - s.fhat).squaredNorm();
    squares[i] += (s.x - s.xhat).cwiseAbs2();
    if (s.w.size() > 0) sums[i].largest_w = std::max(sums[i].largest_w, (s.w - s.what).cwiseAbs().maxCoeff());
  });
  for (std::size_t i = 0; i < count; ++i) {
    for (double* sum : {&sums[i].w, &sums[i].signal_w, &sums[i].f}) *sum = ended ? std::sqrt(*sum / ticks) : NAN;
    sums[i].x = ended ? std::sqrt(squares[i].maxCoeff() / ticks) : NAN;
  }
  return sums;
}

Difference difference(const NetworkSimulation& a, const Example& of_a, const NetworkSimulation& b,
                      const Example& of_b) {
  std::vector<Snapshot> first;
  Difference most;
  run_lane(a, of_a, [&](double, int, const Snapshot& s) { first.push_back(s); });
  std::size_t at = 0;
  run_lane(b, of_b, [&](double, int, const Snapshot& s) {
    const Snapshot& other = first[at++];
    const auto compare = [&](const Eigen::VectorXd& truth, const Eigen::VectorXd& estimate,
                             const Eigen::VectorXd& truth_b, const Eigen::VectorXd& estimate_b) {
      if (estimate.size() == 0) return;
      most.estimates = std::max(most.estimates, (estimate - estimate_b).cwiseAbs().maxCoeff());
      most.errors = std::max(most.errors, (truth - estimate - truth_b + estimate_b).cwiseAbs().maxCoeff());
    };
    compare(other.x, other.xhat, s.x, s.xhat);
    compare(other.w, other.what, s.w, s.what);
    compare(other.f, other.fhat, s.f, s.fhat);
  });
  if (at != first.size() || first.empty()) return {NAN, NAN};
  return most;
}

}  // namespace vigil::observer
