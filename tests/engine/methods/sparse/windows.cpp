#include "tests/engine/methods/sparse/windows.hpp"

namespace vigil::windows {

std::shared_ptr<const Plant> tracker() {
  return Registry<PlantMake>::find("tracker")->make(rig::completed<PlantMake>("tracker"), 0.05);
}

std::shared_ptr<const Sensor> station(const Json& position, const Json& R) {
  return Registry<SensorMake>::find("station")->make(
      rig::completed<SensorMake>("station", {{"position", position}, {"R", R}}), *tracker());
}

Eigen::MatrixXd loop() {
  Eigen::MatrixXd F(6, 6);
  tracker()->jacobian(Eigen::VectorXd::Zero(6), Eigen::VectorXd(), F);
  return F;
}

Eigen::VectorXd normals(std::uint64_t trial, const char* what, std::int64_t k, int size) {
  Eigen::VectorXd v(size);
  Draws(trial, what).normals(k, v);
  return v;
}

Scene scene(std::shared_ptr<const Sensor> sensor, std::uint64_t trial, int T, Tampering tampering) {
  Scene s{std::move(sensor), T, Eigen::MatrixXd(6, T), Eigen::MatrixXd(6, T), {}};
  const Eigen::MatrixXd F = loop(), root = symmetric_root(s.sensor->noise());
  Eigen::VectorXd x(6);
  x << 10, 0, 10, 0, 8, 0;
  for (std::uint64_t k = 0; k < trial * 7 % 190; ++k) x = F * x;
  x += 0.05 * normals(trial, "place", 0, 6);
  const Draws lie(trial, "lie");
  for (int j = 0; j < T; ++j) {
    x = F * x + 0.005 * normals(trial, "process", j, 6);
    Eigen::VectorXd y(6);
    s.sensor->measure(x, y);
    y += root * normals(trial, "sensor", j, 6);
    if (tampering == Tampering::random) {
      y[0] += 10 * lie.uniform(j, 0) - 5;
      y[1] += 2 * std::numbers::pi * lie.uniform(j, 1);
    } else if (tampering == Tampering::constant) {
      y[0] += 5 + 10 * lie.uniform(j, 0);
      y[1] += 2 * std::numbers::pi * lie.uniform(0, 1);
    }
    s.readings.col(j) = y;
    s.met.col(j) = x + 0.02 * normals(trial, "met", j, 6);
  }
  s.prior = s.met.col(T - 1);
  return s;
}

sparse::Regression regress(const Scene& s, sparse::Linearisation where, bool as_printed) {
  sparse::Window window(s.sensor, s.T, where, as_printed);
  for (int j = 0; j < s.T; ++j) window.push(s.readings.col(j), s.met.col(j));
  sparse::Regression regression(6, s.T, 6);
  window.regress(s.prior, sparse::Transition(loop(), s.T), regression);
  return regression;
}

double turned(double angle) { return std::remainder(angle, 2 * std::numbers::pi); }

Eigen::MatrixXd derivative(const Sensor& sensor, const Eigen::VectorXd& x, bool as_printed) {
  Eigen::MatrixXd C(6, 6);
  as_printed ? sensor.jacobian_as_printed(x, C) : sensor.jacobian(x, C);
  return C;
}

Plain plain(const Scene& s, sparse::Linearisation where, bool as_printed) {
  const Eigen::MatrixXd F = loop();
  Plain result{Eigen::VectorXd(6 * s.T), Eigen::MatrixXd(6 * s.T, 6), Eigen::MatrixXd::Zero(6 * s.T, 6 * s.T), {}};
  std::vector<Eigen::VectorXd> z{s.prior};
  while (static_cast<int>(z.size()) < s.T) z.insert(z.begin(), F.fullPivLu().solve(z.front()));
  const Eigen::MatrixXd L = s.sensor->noise().llt().matrixL();
  Eigen::MatrixXd power = Eigen::MatrixXd::Identity(6, 6);
  for (int j = 0; j < s.T; ++j) {
    const Eigen::VectorXd nominal = z[static_cast<std::size_t>(j)];
    const bool frozen = where == sparse::Linearisation::frozen;
    const Eigen::VectorXd point = frozen ? Eigen::VectorXd(s.met.col(j)) : nominal;
    const Eigen::MatrixXd C =
        derivative(*s.sensor, where == sparse::Linearisation::current ? s.prior : point, as_printed);
    Eigen::VectorXd h(6);
    s.sensor->measure(point, h);
    Eigen::VectorXd r = s.readings.col(j) - h;
    r[1] = turned(r[1]);
    if (frozen) r += C * (point - nominal);
    result.r.segment(6 * j, 6) = r;
    result.Phi.middleRows(6 * j, 6) = C * power;
    result.W.block(6 * j, 6 * j, 6, 6) = L.inverse();
    power = F * power;
  }
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(result.W * result.Phi);
  const Eigen::MatrixXd Q1 = qr.householderQ() * Eigen::MatrixXd::Identity(6 * s.T, 6);
  result.M = Eigen::MatrixXd::Identity(6 * s.T, 6 * s.T) - Q1 * Q1.transpose();
  return result;
}

Json coloured() {
  return Json::parse(R"([[4e-4,1e-4,0,0,0,0],[1e-4,1e-4,0,0,0,0],[0,0,2e-4,3e-5,0,0],
                         [0,0,3e-5,1e-4,0,0],[0,0,0,0,1e-4,-2e-5],[0,0,0,0,-2e-5,9e-5]])");
}

}  // namespace vigil::windows
