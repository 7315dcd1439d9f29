/// Noise and initial values.
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <optional>

#include "engine/core/describe.hpp"
#include "engine/core/params.hpp"
#include "engine/scenario/fields.hpp"
#include "engine/scenario/sections.hpp"
#include "engine/world/noise.hpp"

namespace vigil::section {
namespace {

constexpr double kRounding = 1e-9;

const ParamTable& table() {
  static const ParamTable noise(std::vector<Param>{
      {.name = "Q", .type = ParamType::matrix, .fallback = 0, .minimum = 0},
      {.name = "P0", .type = ParamType::matrix, .fallback = 0, .minimum = 0},
      {.name = "Mw", .type = ParamType::matrix, .fallback = 0, .minimum = 0},
      {.name = "law", .type = ParamType::text, .fallback = "gauss", .choices = law_names()},
      {.name = "bounded", .type = ParamType::text, .fallback = "uniform", .choices = bounded_law_names()}});
  return noise;
}

/// Why a square matrix is no covariance, or not a positive definite one where that is wanted; "" where it is.
std::string not_covariance(const Eigen::MatrixXd& matrix, bool definite) {
  // Scaled first, so that entries near the largest number do not overflow on the way.
  const double scale = matrix.cwiseAbs().maxCoeff();
  if (scale == 0) return definite ? "is not positive definite" : "";
  const Eigen::MatrixXd unit = matrix / scale;
  const double asymmetry = (unit - unit.transpose()).cwiseAbs().maxCoeff();
  if (asymmetry > kRounding) return "is not symmetric";
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(unit, Eigen::EigenvaluesOnly);
  const double least = solver.eigenvalues().minCoeff();
  if (!(least >= -kRounding)) return "has the negative eigenvalue " + number_text(least * scale);
  if (definite && Eigen::LLT<Eigen::MatrixXd>(unit).info() != Eigen::Success) return "is not positive definite";
  return {};
}

void check_covariance(const std::string& name, const Json& value, int states, bool definite,
                      std::vector<Problem>& problems) {
  constexpr std::size_t kMost = 64;
  const std::string pointer = "/noise/" + name;
  const std::string expected =
      std::string("a symmetric positive ") + (definite ? "definite" : "semidefinite") + " matrix";
  const auto size = states > 0 ? static_cast<std::size_t>(states) : value.is_array() ? value.size() : 1;
  if (size > kMost) {
    problems.push_back(
        {pointer, name + " has " + std::to_string(size) + " rows; expected at most 64", "at most 64 rows"});
    return;
  }
  try {
    const std::string why = not_covariance(square_matrix(value, static_cast<int>(size), pointer), definite);
    if (!why.empty())
      problems.push_back({pointer, name + " is " + shown(value) + " and " + why + "; expected " + expected, expected});
  } catch (const InputError& error) {
    problems.push_back({pointer, name + " is " + error.problems().front().detail, error.problems().front().allowed});
  }
}

bool is_state(const Json& value, int states) {
  if (!value.is_array() || value.empty() || value.size() > 64) return false;
  if (states > 0 && value.size() != static_cast<std::size_t>(states)) return false;
  for (const auto& entry : value) {
    if (!entry.is_number()) return false;
  }
  return true;
}

std::string state_words(int states) {
  return states > 0 ? "a vector of " + std::to_string(states) + " numbers" : "a vector of 1 to 64 numbers";
}

Json estimates(Fields& fields, const Json& nodes, int states, std::vector<Problem>& problems) {
  const Json& given = fields.at("estimates");
  if (given.is_null() || given == "truth" || given == "stationary") return given;
  if (!given.is_object()) {
    fields.wrong("estimates", "{\"<node>\":[..]}, \"truth\", \"stationary\" or null");
    return nullptr;
  }
  std::vector<std::string> ids;
  for (const auto& [key, value] : nodes.items()) ids.push_back(key);
  Fields members(given, "/initial/estimates", problems);
  members.known(ids);
  Json result = Json::object();
  for (const auto& id : ids) {
    if (!members.has(id)) continue;
    if (is_state(members.at(id), states)) {
      result[id] = members.at(id);
    } else {
      members.wrong(id, state_words(states));
    }
  }
  return result;
}

}  // namespace

Json noise(const Json& given, const Json& document, int states, std::vector<Problem>& problems) {
  const Json section = given.contains("noise") ? given["noise"] : Json::object();
  const Fields checked(section, "/noise", problems);
  if (!section.is_object()) return Json::object();
  const std::size_t before = problems.size();
  Json result = table().complete(section, "/noise", problems);
  if (problems.size() > before) return result;
  const bool definite = document["family"] == "sparse";  // its regressions and information forms invert them
  for (const char* name : {"Q", "P0"}) check_covariance(name, result[name], states, definite, problems);
  check_covariance("Mw", result["Mw"], states, false, problems);
  return result;
}

Json initial(const Json& given, const Json& document, int states, std::vector<Problem>& problems) {
  const Json section = given.contains("initial") ? given["initial"] : Json::object();
  Fields fields(section, "/initial", problems);
  fields.known({"truth", "estimates", "x0_random"});
  const Json& truth = fields.at("truth");
  if (!truth.is_null() && !is_state(truth, states)) fields.wrong("truth", state_words(states) + " or null");
  return {{"truth", truth},
          {"estimates", estimates(fields, document["nodes"], states, problems)},
          {"x0_random", fields.boolean("x0_random", false)}};
}

}  // namespace vigil::section
