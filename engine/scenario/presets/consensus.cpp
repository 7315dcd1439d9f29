/// Seed 000: eight cameras, a robot on a circle, an attacker on the links. Three readings of the same paper.
#include <array>
#include <utility>

#include "engine/scenario/presets/presets.hpp"

namespace vigil::presets {
namespace {

/// One column of the table in section 11 of the specification.
struct Profile {
  std::string id, name;
  Json title;
  double kappa = 0;
  double right = 0, left = 0, base = 0;  ///< wheels: way per step and distance, in the profile's length unit
  Json start;
  double d1 = 0, d2 = 0;
  std::array<std::pair<double, double>, 8> cameras;
  Json Q, R, P0;
  double U = 0, V = 0;
  std::string guard;
  bool compass = false;
  std::string length, heading;  ///< units for the eye
};

constexpr double kDegree = 3.14159265358979323846 / 180;

Profile cmdeg() {
  Profile profile;
  profile.id = "consensus";
  profile.name = "cmdeg";
  profile.title = {{"en", "Eight cameras, one robot, attacked links"}, {"zh", "八个摄像机、一台机器人与受攻击的链路"}};
  profile.kappa = kDegree;
  profile.right = 10.4;
  profile.left = 5.6;
  profile.base = 30;
  profile.start = {150, 70, 0};
  profile.d1 = -6.68;
  profile.d2 = 5.36;
  profile.cameras = {{{60, 60}, {60, 180}, {120, 180}, {180, 180}, {240, 180}, {240, 160}, {180, 120}, {120, 120}}};
  profile.Q = profile.P0 = {1, 1, 1};
  profile.R = {1, 1};
  profile.U = 0.01;
  profile.V = 0.1;
  profile.guard = "clip";
  profile.length = "cm";
  profile.heading = "deg";
  return profile;
}

Json plant(const Profile& profile) {
  return {{"type", "unicycle_wheels"},
          {"params",
           {{"kappa", profile.kappa},
            {"sR", profile.right},
            {"sL", profile.left},
            {"b", profile.base},
            {"length_unit", profile.length},
            {"heading_unit", profile.heading}}}};
}

Json nodes(const Profile& profile) {
  Json result = Json::object();
  for (std::size_t n = 0; n < profile.cameras.size(); ++n) {
    const Json params = {{"position", {profile.cameras[n].first, profile.cameras[n].second}},
                         {"z", 2.105},
                         {"gamma_u", 9.0213283},
                         {"gamma_v", 9.0250141},
                         {"p0", 347.20436},
                         {"q0", 284.3475},
                         {"d1", profile.d1},
                         {"d2", profile.d2},
                         {"kappa", profile.kappa},
                         {"compass", profile.compass},
                         {"R", profile.R}};
    result[std::to_string(n + 1)] = {{"sensor", {{"type", "camera"}, {"params", params}}}};
  }
  return result;
}

Json filter(const Profile& profile, const char* mode) {
  return {{"mode", mode},   {"tau", 0.01},    {"sigma", 0.1},           {"beta", 0.1}, {"eps", nullptr},
          {"U", profile.U}, {"V", profile.V}, {"guard", profile.guard}, {"rho", 0.9},  {"bound", "paper"}};
}

Json lanes(const Profile& profile) {
  const auto lane = [&profile](const char* mode) {
    return Json{{"method", "consensus_ekf"}, {"params", filter(profile, mode)}};
  };
  Json result = Json::object();
  result["consensus"] = lane("filter");
  result["clean"] = {{"method", "consensus_ekf"}, {"adversary", false}, {"params", filter(profile, "filter")}};
  result["drop"] = lane("drop");
  result["naive_hold"] = lane("naive_hold");
  result["naive_zero"] = lane("naive_zero");
  result["isolated"] = {{"method", "local_ekf"}};
  result["centralized"] = {{"method", "centralized_ekf"}};
  return result;
}

Json adversary() {
  return {{"links",
           {{"type", "dos_fdi"},
            {"on", Json::array({"link:*"})},
            {"params",
             {{"pdos", 0.2},
              {"pfdi", 0.2},
              {"xi_dir", {1.5, 1.5, 0}},
              {"xi_scale", 1},
              {"xi_const", false},
              {"s_std", 1}}}}}};
}

Json document(const Profile& profile) {
  return {{"vigil", 1},
          {"id", profile.id},
          {"title", profile.title},
          {"source", "seed 000"},
          {"family", "consensus"},
          {"profile", profile.name},
          {"time", {{"dt", 1}, {"steps", 30}}},
          {"plant", plant(profile)},
          {"nodes", nodes(profile)},
          {"network", {{"graph", "ladder"}}},
          {"noise", {{"Q", profile.Q}, {"P0", profile.P0}}},
          {"initial", {{"truth", profile.start}}},
          {"adversary", adversary()},
          {"lanes", lanes(profile)},
          {"view",
           {{"plane", {{"components", {"x", "y"}}, {"heading", "theta"}, {"unit", profile.length}}},
            {"lane", "consensus"},
            {"error_unit", profile.length}}}};
}

}  // namespace

Json consensus() { return document(cmdeg()); }

Json consensus_compass() {
  Profile profile = cmdeg();
  profile.id = "consensus-compass";
  profile.name = "compass";
  profile.title = {{"en", "Eight cameras with a compass: the theorem's conditions hold"},
                   {"zh", "带罗盘的八个摄像机：定理条件始终成立"}};
  profile.Q = {0.04, 0.04, 0.04};
  profile.R = profile.P0 = {0.25, 0.25, 0.25};
  profile.U = 0.005;
  profile.V = 0.02;
  profile.guard = "strict";
  profile.compass = true;
  return document(profile);
}

Json consensus_literal() {
  Profile profile = cmdeg();
  profile.id = "consensus-literal";
  profile.name = "literal";
  profile.title = {{"en", "The paper's numbers read literally, in metres and radians: nothing tracks"},
                   {"zh", "按字面理解论文数值（米与弧度）：无法跟踪"}};
  profile.kappa = 1;
  profile.right = 0.104;
  profile.left = 0.056;
  profile.base = 0.3;
  profile.start = {1.5, 0.7, 0};
  profile.d1 = -0.0668;
  profile.d2 = 0.0536;
  profile.cameras = {{{0.6, 0.6}, {0.6, 1.8}, {1.2, 1.8}, {1.8, 1.8}, {2.4, 1.8}, {2.4, 1.6}, {1.8, 1.2}, {1.2, 1.2}}};
  profile.length = "m";
  profile.heading = "rad";
  return document(profile);
}

}  // namespace vigil::presets
