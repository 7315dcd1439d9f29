#include "engine/world/interconnected/examples.hpp"

#include <numbers>

namespace vigil::observer {
namespace {

using Matrix = Eigen::MatrixXd;
using std::numbers::pi;

Matrix rows(int count, std::initializer_list<double> entries) {
  const auto columns = static_cast<Eigen::Index>(entries.size()) / count;
  return Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(entries.begin(),
                                                                                                  count, columns);
}
Matrix column(std::initializer_list<double> entries) { return rows(static_cast<int>(entries.size()), entries); }

Subsystem first_of_pair() {
  Subsystem s;
  s.name = "1";
  s.A = rows(4, {-1, 0, 0, 0, 1, -2, 0, 0, 1, 0, -1, 1.5, 0, 2, 0, -1});
  s.C = rows(3, {1, 0, 0, 0, 0, 1, .2, 0, 1, 1, 2, 0});
  s.B = s.F = s.D = column({1, 0, 1, 0});
  s.Dd = column({-1, 0, 1, .5});
  s.G = column({1, 0, 1});
  s.alpha = 1;
  s.tau = 2;
  s.kappa = 6;
  s.varsigma = 9;
  complete(s);
  return s;
}

Subsystem second_of_pair() {
  Subsystem s;
  s.name = "2";
  s.A = rows(3, {-1, 1, 0, 1, -2, 0, 1, 0, -1});
  s.C = rows(3, {1, 2, -1, -1, 0, 0, 1, 1, 2});
  s.B = s.D = column({1, 1, 1});
  s.F = column({1, 0, 1});
  s.Dd = column({0, 1, -1});
  s.G = column({1, -2, 1});
  s.alpha = -1;
  s.tau = 3;
  s.kappa = 5;
  s.varsigma = 3;
  complete(s);
  return s;
}

Matrix from_2_to_1() { return rows(4, {-.05, 0, 0, 0, 0, -.1, 0, 0, 0, 0, 0, 0}); }
Matrix from_1_to_2() { return rows(3, {.1, 0, .2, 0, .05, 0, 0, 0, 0, .1, 0, 0}); }

SubsystemSignals signals_of_first() {
  SubsystemSignals s;
  s.w = {Signal({{.until = 2}, {.until = 6, .sine = 2, .rate = pi}, {.cosine = 1, .rate = pi}})};
  s.f = {Signal(
      {{.until = .25}, {.until = 3, .sine = .5, .rate = 20, .phase = -1}, {.offset = 1, .sine = -1, .rate = 5 * pi}})};
  s.d = {Signal({{.sine = 1, .rate = .7 * pi}})};
  return s;
}

SubsystemSignals signals_of_second() {
  SubsystemSignals s;
  s.w = {Signal(
      {{.until = .25}, {.until = 5.5, .sine = .5, .rate = 5 * pi, .phase = -1}, {.cosine = 1, .rate = .5 * pi}})};
  s.f = {Signal({{.until = 1.5}, {.until = 3.5, .cosine = 1, .rate = 5 * pi}, {.sine = 1, .rate = .5 * pi}})};
  s.d = {Signal({{.cosine = -1, .rate = .4 * pi}})};
  return s;
}

Subsystem odd_area() {
  const double Dp = 1.5, Hp = .02, Tch = .17, Tg = .4, R = .05, S = 2 * 2 * pi * .05;
  Subsystem s;
  s.A = rows(4, {-Dp / (2 * Hp), 1 / (2 * Hp), 0, -1 / (2 * Hp), 0, -1 / Tch, 1 / Tch, 0, -1 / (R * Tg), 0, -1 / Tg, 0,
                 S, 0, 0, 0});
  s.B = column({0, 0, 1 / Tg, 0});
  s.D = column({1, 0, 1, 0});
  s.C = rows(3, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0});
  return s;
}

Subsystem even_area(AreaOutputs outputs) {
  Subsystem s;
  s.A = rows(4, {-1.5, 1, -.7, .3, -1.5, .6, .8, .2, 0, .3, -2, 2, 2, -1.5, .5, -2});
  s.B = column({0, 0, 1 / .35, 0});
  s.D = column({1, 0, 0, 0});
  s.C = outputs == AreaOutputs::case_1 ? rows(3, {1, 0, 0, 0, 0, 1, .2, 0, 1, 1, 0, 0})
                                       : rows(3, {0, 0, 1, 1, 0, 0, 1, .2, 0, 1, 1, 0});
  return s;
}

std::vector<SubsystemSignals> signals_of_areas(bool attack_area_2) {
  std::vector<SubsystemSignals> s(4);
  const Piece quick{.sine = .02, .rate = 5 * pi};
  Piece before = quick, after = quick;
  before.until = 3;
  after.until = 9;
  s[0].w = {Signal({{.until = 2}, before, {.until = 8, .sine = .2, .rate = 3 * pi}, after, {}})};
  s[2].w = {Signal({{.until = 5}, {.until = 7, .slope = .1}, {.cosine = 1, .rate = .5 * pi}})};
  if (attack_area_2) s[1].w = {Signal({{.sine = 1, .rate = 1}})};
  return s;
}

}  // namespace

Example pair() {
  Example e;
  e.network.subsystems = {first_of_pair(), second_of_pair()};
  e.network.couplings = {{0, 1, from_2_to_1()}, {1, 0, from_1_to_2()}};
  e.x0 = {column({.03358, .005, 0, 0}), column({-.0626, 0, 0})};
  e.signals = {signals_of_first(), signals_of_second()};
  e.horizon = 20;
  return e;
}

Example areas(AreaOutputs outputs, Topology topology, bool attack_area_2) {
  Example e;
  const Matrix H = Eigen::Vector4d(-.05, -.1, 0, 0).asDiagonal();
  for (int i = 0; i < 4; ++i) {
    Subsystem s = i % 2 == 0 ? odd_area() : even_area(outputs);
    s.name = std::to_string(i + 1);
    s.alpha = -1;
    complete(s);
    e.network.subsystems.push_back(s);
    for (int j = 0; j < 4; ++j) {
      const bool near = (i + 1) % 4 == j || (j + 1) % 4 == i;
      if (i != j && (topology == Topology::full || near)) e.network.couplings.push_back({i, j, H});
    }
  }
  e.x0.assign(4, Eigen::VectorXd::Zero(4));
  e.signals = signals_of_areas(attack_area_2);
  e.horizon = 15;
  return e;
}

Example single() {
  Example e;
  e.network.subsystems = {second_of_pair()};
  e.network.subsystems[0].name = "1";  // alone it is the first
  e.x0 = {column({-.0626, 0, 0})};
  e.signals = {signals_of_second()};
  e.horizon = 20;
  return e;
}

Network ring(int k) {
  Network network;
  for (int i = 0; i < k; ++i) {
    Subsystem s = i % 2 == 0 ? first_of_pair() : second_of_pair();
    s.name = std::to_string(i + 1);
    network.subsystems.push_back(s);
  }
  const auto couple = [&](int to, int from) {
    if (to % 2 != from % 2 && network.coupling(to, from) == nullptr) {
      network.couplings.push_back({to, from, to % 2 == 0 ? from_2_to_1() : from_1_to_2()});
    }
  };
  for (int i = 0; i < k; ++i) {
    couple(i, (i + 1) % k);
    couple((i + 1) % k, i);
  }
  return network;
}

}  // namespace vigil::observer
