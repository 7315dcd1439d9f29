/// Seed 001: five ground stations, one target in space, an attacker on range and azimuth. Specification of seed 001,
/// sections 2 to 6.
#include <array>
#include <cmath>
#include <optional>

#include "engine/scenario/presets/presets.hpp"

namespace vigil::presets {
namespace {

constexpr double kStep = 0.05;  ///< s

Json diagonal(double value) { return Json::array({value, value, value, value, value, value}); }

Json nodes() {
  // A circle of radius 10 about the end of the track, on the ground: the source does not say where they stand.
  constexpr std::array<std::array<int, 2>, 5> kPlaces{{{-6, 8}, {-10, 0}, {-6, -8}, {6, -8}, {0, -10}}};
  Json result = Json::object();
  for (std::size_t n = 0; n < kPlaces.size(); ++n) {
    const Json params = {{"position", {kPlaces[n][0], kPlaces[n][1], 0}}, {"R", diagonal(1e-4)}};
    result[std::to_string(n + 1)] = {{"sensor", {{"type", "station"}, {"params", params}}}};
  }
  return result;
}

/// Acts for t in [start, end), in seconds; no end: to the last tick, which is included.
Json attack(const char* node, const char* kind, double start, std::optional<double> end) {
  Json result = {{"type", "radar_fdi"},
                 {"on", Json::array({std::string("sensor:") + node})},
                 {"from", std::llround(start / kStep)},
                 {"to", nullptr},
                 {"params", {{"kind", kind}}}};
  if (end) result["to"] = std::llround(*end / kStep) - 1;
  return result;
}

/// Table 1.
Json adversary() {
  return {{"node1", attack("1", "I", 9, std::nullopt)},
          {"node2", attack("2", "I", 0, 6)},
          {"node3", attack("3", "II", 6, std::nullopt)},
          {"node4", attack("4", "II", 0, 6)},
          {"node5", attack("5", "I", 6, std::nullopt)}};
}

Json lanes() {
  Json result = Json::object();
  result["omp_game"] = {{"method", "omp_game"}};
  result["l1"] = {{"method", "l1_ekf"}};
  result["dkf"] = {{"method", "kalman_consensus"}};
  result["etpg"] = {{"method", "etpg_ekf"}};
  result["sdlms"] = {{"method", "diffusion_lms"}};
  result["omp"] = {{"method", "omp_ekf"}};
  result["ekf"] = {{"method", "window_ekf"}};
  result["pred"] = {{"method", "dead_reckoning"}, {"params", {{"at", "nodes"}}}};
  result["omp_game_channels"] = {{"method", "omp_game_channels"}};
  return result;
}

}  // namespace

Json sparse() {
  return {
      {"vigil", 1},
      {"id", "sparse"},
      {"title",
       {{"en", "Five radars, one target, false ranges and azimuths"},
        {"zh", "五部雷达、一个目标与虚假的距离和方位角"}}},
      {"source", "seed 001"},
      {"family", "sparse"},
      {"time", {{"dt", kStep}, {"steps", 200}}},
      {"plant",
       {{"type", "tracker"},
        {"params", {{"poles_x", {0.99, 0.01}}, {"poles_y", {0.98, 0.02}}, {"poles_z", {0.97, 0.03}}}}}},
      {"nodes", nodes()},
      {"network",
       {{"graph", "edges"}, {"edges", Json::array({{1, 2}, {1, 3}, {1, 4}, {1, 5}, {2, 5}, {3, 4}, {3, 5}})}}},
      {"noise", {{"Q", diagonal(2.5e-5)}, {"P0", diagonal(0.01)}}},
      {"initial", {{"truth", {10, 0, 10, 0, 8, 0}}, {"estimates", "truth"}}},
      {"adversary", adversary()},
      {"lanes", lanes()},
      {"metrics", {{"mse", {{"mse_px", {{"component", "px"}}}, {"mse_px_0_9s", {{"component", "px"}, {"to", 179}}}}}}},
      {"view",
       {{"space", {{"components", {"px", "py", "pz"}}, {"unit", "m"}}},
        {"plane", {{"components", {"px", "py"}}, {"unit", "m"}}},
        {"lane", "omp_game"},
        {"error_unit", "m"},
        {"errors", {"px", "vx"}}}}};
}

}  // namespace vigil::presets
