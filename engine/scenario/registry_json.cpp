#include "engine/adversary/attack.hpp"
#include "engine/methods/method.hpp"
#include "engine/scenario/scenario.hpp"
#include "engine/world/plant.hpp"
#include "engine/world/sensor.hpp"

namespace vigil {
namespace {

Json entry_json(const std::string& id, const Words& title, const std::string& source, Json parameters) {
  return {{"id", id},
          {"title", {{"en", title.en}, {"zh", title.zh}}},
          {"source", source},
          {"parameters", std::move(parameters)}};
}

template <class Make>
Json kind_json() {
  Json list = Json::array();
  for (const auto& entry : Registry<Make>::all()) {
    list.push_back(entry_json(entry.id, entry.title, entry.source, entry.params.to_json()));
  }
  return list;
}

/// Every noise of a document is normal so far; its covariances stand where the noise is declared.
Json laws() {
  return Json::array({entry_json("normal", {"Normal noise with the given covariance", "具有给定协方差的正态噪声"},
                                 "noise.Q, noise.P0 and a sensor's R", Json::array())});
}

}  // namespace

Json registry_json() {
  return {{"methods", kind_json<MethodMake>()},
          {"attacks", kind_json<AttackMake>()},
          {"plants", kind_json<PlantMake>()},
          {"sensors", kind_json<SensorMake>()},
          {"laws", laws()}};
}

}  // namespace vigil
