/// Seed 004: sensors that send what they estimate to a fusion centre, somebody who listens, and what hides it.
#include <cmath>

#include "engine/methods/privacy/landmark_robot.hpp"
#include "engine/methods/privacy/model.hpp"
#include "engine/scenario/presets/presets.hpp"

namespace vigil::presets {
namespace {

Json rows(const Eigen::MatrixXd& matrix) {
  Json result = Json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    Json row = Json::array();
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) row.push_back(matrix(i, j));
    result.push_back(std::move(row));
  }
  return result;
}

Json numbers(const Eigen::VectorXd& vector) { return std::vector<double>(vector.begin(), vector.end()); }

Json linear_nodes(const privacy::FusionModel& model) {
  Json result = Json::object();
  for (std::size_t i = 0; i < model.sensors.size(); ++i) {
    const Json params = {{"C", rows(model.sensors[i].C)}, {"R", rows(model.sensors[i].R)}};
    result[std::to_string(i + 1)] = {{"sensor", {{"type", "linear"}, {"params", params}}}};
  }
  return result;
}

Json lane(const char* filter, Json protection = nullptr) {
  Json result = {{"method", "fusion"}, {"params", {{"filter", filter}}}};
  if (!protection.is_null()) result["protection"] = std::move(protection);
  return result;
}

Json protection(const char* type, Json params = Json::object()) {
  return {{"type", type}, {"params", std::move(params)}};
}

Json document(const char* id, Json title, int steps) {
  return {{"vigil", 1},
          {"id", id},
          {"title", std::move(title)},
          {"source", "seed 004"},
          {"family", "privacy"},
          {"time", {{"dt", 1}, {"steps", steps}}},
          {"network", {{"graph", "centre"}}},
          {"adversary", {{"eve", {{"type", "eavesdrop"}, {"on", Json::array({"link:*"})}, {"from", 0}}}}},
          {"log", {{"signals", Json::array({"*"})}}}};
}

}  // namespace

Json privacy_robot_linear() {
  const privacy::FusionModel model = privacy::linear_robot();
  Json result = document(
      "privacy-robot-linear",
      {{"en", "A robot on a line, its estimates contaminated"}, {"zh", "直线机器人：零空间噪声污染估计"}}, 100);
  result["plant"] = {{"type", "line_target"}};
  result["nodes"] = linear_nodes(model);
  result["noise"] = {{"Q", rows(model.noise())}, {"P0", rows(model.P0)}};
  result["initial"] = {{"truth", numbers(model.x0)}, {"estimates", "truth"}, {"x0_random", true}};
  result["lanes"] = {{"unprotected", lane("time_varying")},
                     {"contamination", lane("time_varying", protection("contamination", {{"m", 3}}))},
                     {"complex_noise", lane("time_varying", protection("complex_noise"))}};
  result["view"] = {{"lane", "contamination"}};
  return result;
}

Json privacy_robot_nonlinear() {
  const privacy::LandmarkRobot robot;
  const privacy::LandmarkNoise noise = privacy::landmark_noise();
  Json result = document(
      "privacy-robot-nonlinear",
      {{"en", "A robot among landmarks, its estimates contaminated"}, {"zh", "路标间机器人：零空间噪声污染估计"}}, 100);
  result["plant"] = {{"type", "landmark_robot"}, {"params", {{"zv", robot.speed}, {"zw", robot.turn}}}};
  for (std::size_t i = 0; i < robot.landmarks.size(); ++i) {
    Json places = Json::array();
    for (const Eigen::Vector2d& place : robot.landmarks[i]) places.push_back(numbers(place));
    const Json params = {{"landmarks", std::move(places)}, {"R", rows(noise.R[i])}};
    result["nodes"][std::to_string(i + 1)] = {{"sensor", {{"type", "landmarks"}, {"params", params}}}};
  }
  result["noise"] = {{"Q", rows(noise.Q)}, {"P0", rows(noise.P0)}};
  result["initial"] = {{"truth", {0, 0, 0}}, {"estimates", "truth"}, {"x0_random", true}};
  result["lanes"] = {{"unprotected", lane("extended")},
                     {"contamination", lane("extended", protection("contamination", {{"m", 4}}))}};
  result["view"] = {{"lane", "contamination"}};
  return result;
}

Json privacy_turn() {
  const privacy::FusionModel model = privacy::turning_target();
  Json result = document(
      "privacy-turn",
      {{"en", "A turning target, its fused estimates published with noise"}, {"zh", "转弯目标：差分隐私融合估计"}},
      100);
  result["plant"] = {{"type", "turning_target"}, {"params", {{"p", 0.1}}}};
  result["nodes"] = linear_nodes(model);
  result["noise"] = {{"Q", rows(model.noise())}, {"P0", 0}};
  result["initial"] = {{"truth", numbers(model.x0)}, {"estimates", "stationary"}};
  const Json settings = {{"epsilon", std::log(2.0)}, {"delta", 0.1}, {"lambda", 1}, {"kappa", 10}, {"H", {1, 0, 1, 0}}};
  Json one_sensor = settings;
  one_sensor["shares"] = {0, 1};
  result["lanes"] = {{"unprotected", lane("stationary")},
                     {"dp_centre", lane("stationary", protection("dp_centre", settings))},
                     {"dp_uniform", lane("stationary", protection("dp_sensors", settings))},
                     {"dp_one_sensor", lane("stationary", protection("dp_sensors", one_sensor))}};
  result["view"] = {{"lane", "dp_uniform"}};
  return result;
}

Json privacy_engine() {
  const privacy::FusionModel model = privacy::engine_model();
  Json result = document(
      "privacy-engine",
      {{"en", "An engine, four ways to hide what its sensors say"}, {"zh", "发动机：四种保护机制的保密性对比"}}, 200);
  result["plant"] = {{"type", "linear"}, {"params", {{"A", rows(model.A)}}}};
  result["nodes"] = linear_nodes(model);
  result["noise"] = {{"Q", rows(model.noise())}, {"P0", 0}};
  result["initial"] = {{"truth", numbers(model.x0)}, {"estimates", "stationary"}, {"x0_random", true}};
  const Json two_step = {{"epsilon", std::log(2.0)}, {"delta", 0.1},  {"zeta", 0.1}, {"tq", 5},
                         {"q_alpha", 0.01},          {"H", {1, 1, 1}}};
  result["lanes"] = {
      {"unprotected", lane("stationary")},
      {"two_step", lane("stationary", protection("two_step", two_step))},
      {"contamination", lane("stationary", protection("contamination", {{"m", 5}}))},
      {"secrecy_code_a", lane("stationary", protection("secrecy_code", {{"code", "A"}, {"loss", 0.36}}))},
      {"secrecy_code_l", lane("stationary", protection("secrecy_code", {{"code", "L"}, {"loss", 0.36}}))}};
  result["view"] = {{"lane", "two_step"}};
  return result;
}

}  // namespace vigil::presets
