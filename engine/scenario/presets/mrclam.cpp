/// A real robot among fifteen landmarks. The trace brings readings, odometry, landmark positions and the truth.
#include "engine/scenario/presets/presets.hpp"

namespace vigil::presets {
namespace {

Json nodes() {
  Json result = Json::object();
  for (int subject = 6; subject <= 20; ++subject) {
    const Json params = {{"position", nullptr}, {"R", {0.0225, 0.0036}}};
    result[std::to_string(subject)] = {{"sensor", {{"type", "range_bearing"}, {"params", params}}}};
  }
  return result;
}

Json lanes() {
  const Json filter = {{"mode", "filter"}, {"tau", 0.02}, {"sigma", 0.1},    {"beta", 0.1}, {"eps", nullptr},
                       {"U", 0.01},        {"V", 0.01},   {"guard", "clip"}, {"rho", 0.9},  {"bound", "paper"}};
  Json result = Json::object();
  result["consensus"] = {{"method", "consensus_ekf"}, {"params", filter}};
  result["isolated"] = {{"method", "local_ekf"}};
  result["centralized"] = {{"method", "centralized_ekf"}};
  result["centralized_gated"] = {{"method", "centralized_ekf"}, {"params", {{"gate", 0.99}}}};
  result["dead_reckoning"] = {{"method", "dead_reckoning"}};
  return result;
}

}  // namespace

Json mrclam() {
  return {{"vigil", 1},
          {"id", "mrclam"},
          {"title", {{"en", "A recorded robot among fifteen landmarks"}, {"zh", "十五个路标之间的实录机器人"}}},
          {"source", "UTIAS MRCLAM data set 6, robot 3; methods of seed 000"},
          {"family", "consensus"},
          {"profile", "recorded"},
          {"time", {{"dt", 0.1}, {"steps", nullptr}}},
          {"plant", {{"type", "unicycle"}}},
          {"nodes", nodes()},
          {"network", {{"graph", "knn3"}}},
          {"noise", {{"Q", {6.25e-6, 6.25e-6, 4e-4}}, {"P0", {0.01, 0.01, 0.01}}}},
          {"initial", {{"estimates", "truth"}}},
          {"adversary",
           {{"links",
             {{"type", "dos_fdi"},
              {"on", Json::array({"link:*"})},
              {"params", {{"pdos", 0.2}, {"pfdi", 0.2}, {"xi_dir", {0.1, 0.1, 0}}}}}}}},
          {"lanes", lanes()},
          {"view",
           {{"plane", {{"components", {"x", "y"}}, {"heading", "theta"}, {"unit", "m"}}},
            {"lane", "consensus"},
            {"error_unit", "m"}}}};
}

}  // namespace vigil::presets
