/// Problems and solutions as documents: how they go to another process and come back.
#include <stdexcept>

#include "engine/core/input_error.hpp"
#include "engine/linalg/sdp.hpp"

namespace vigil {
namespace {

constexpr SdpVerdict kVerdicts[] = {SdpVerdict::solved, SdpVerdict::stopped, SdpVerdict::infeasible,
                                    SdpVerdict::timed_out, SdpVerdict::failed};

SdpVerdict verdict_of(const std::string& word) {
  for (const SdpVerdict verdict : kVerdicts) {
    if (to_string(verdict) == word) return verdict;
  }
  throw std::invalid_argument("no such verdict: \"" + word + "\"");
}

/// The readers below ask the JSON library for what they need; whatever it or they object to is bad input.
template <class Read>
auto reading(const std::string& pointer, const char* what, Read read) {
  try {
    return read();
  } catch (const Json::exception& error) {
    throw InputError(pointer, std::string(what) + " cannot be read: " + error.what());
  } catch (const std::invalid_argument& error) {
    throw InputError(pointer, std::string(what) + " cannot be read: " + error.what());
  }
}

}  // namespace

std::string_view to_string(SdpVerdict verdict) {
  switch (verdict) {
    case SdpVerdict::solved:
      return "solved";
    case SdpVerdict::stopped:
      return "stopped";
    case SdpVerdict::infeasible:
      return "infeasible";
    case SdpVerdict::timed_out:
      return "timed_out";
    case SdpVerdict::failed:
      return "failed";
  }
  return "failed";
}

Json to_json(const SdpProblem& problem) {
  Json entries = Json::array();
  for (const SdpEntry& entry : problem.entries) {
    entries.push_back(Json::array({entry.matrix, entry.block, entry.row, entry.column, entry.value}));
  }
  return {{"cost", problem.cost}, {"blocks", problem.blocks}, {"entries", std::move(entries)}};
}

SdpProblem read_sdp(const Json& document, const std::string& pointer) {
  return reading(pointer, "a semidefinite program", [&] {
    SdpProblem problem;
    document.at("cost").get_to(problem.cost);
    document.at("blocks").get_to(problem.blocks);
    for (const Json& row : document.at("entries")) {
      problem.entries.push_back({row.at(0).get<int>(), row.at(1).get<int>(), row.at(2).get<int>(), row.at(3).get<int>(),
                                 row.at(4).get<double>()});
    }
    canonicalise(problem);
    return problem;
  });
}

Json to_json(const SdpSolution& solution) {
  const bool usable = solution.y.allFinite();
  return {{"y", usable ? std::vector<double>(solution.y.begin(), solution.y.end()) : std::vector<double>()},
          {"verdict", to_string(usable ? solution.verdict : SdpVerdict::failed)},
          {"iterations", solution.iterations},
          {"seconds", solution.seconds},
          {"detail", solution.detail}};
}

SdpSolution read_sdp_solution(const Json& document, const std::string& pointer) {
  return reading(pointer, "a solution", [&] {
    const auto y = document.at("y").get<std::vector<double>>();
    SdpSolution solution;
    solution.y = Eigen::Map<const Eigen::VectorXd>(y.data(), static_cast<Eigen::Index>(y.size()));
    solution.verdict = verdict_of(document.at("verdict").get<std::string>());
    document.at("iterations").get_to(solution.iterations);
    document.at("seconds").get_to(solution.seconds);
    document.at("detail").get_to(solution.detail);
    return solution;
  });
}

}  // namespace vigil
