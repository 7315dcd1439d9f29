#include "engine/adversary/attack.hpp"
#include "engine/methods/detectors/detector.hpp"
#include "engine/methods/privacy/protection.hpp"
#include "engine/scenario/scenario.hpp"
#include "engine/world/controller.hpp"
#include "engine/world/interconnected/waveform.hpp"
#include "engine/world/noise.hpp"
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
void add_traits(const Traits<Make>& /*none*/, Json& /*entry*/) {}

void add_traits(const Traits<AttackMake>& traits, Json& entry) {
  entry["acts_on"] = Json::array();
  for (const ChannelKind kind : traits.acts_on) entry["acts_on"].push_back(word(kind));
}

template <class Make>
Json kind_json() {
  Json list = Json::array();
  for (const auto& entry : Registry<Make>::all()) {
    list.push_back(entry_json(entry.id, entry.title, entry.source, entry.params.to_json()));
    add_traits(entry.traits, list.back());
  }
  return list;
}

Json laws() {
  Json list = Json::array();
  for (std::size_t i = 0; i < law_names().size(); ++i) {
    list.push_back(entry_json(law_names()[i], law_words(static_cast<Law>(i)),
                              "noise.law; specification of seed 003, section 3", Json::array()));
  }
  return list;
}

}  // namespace

Json registry_json() {
  return {{"methods", kind_json<MethodMake>()},
          {"protections", kind_json<ProtectionMake>()},
          {"detectors", kind_json<DetectorMake>()},
          {"attacks", kind_json<AttackMake>()},
          {"plants", kind_json<PlantMake>()},
          {"sensors", kind_json<SensorMake>()},
          {"controllers", kind_json<ControllerMake>()},
          {"signals", kind_json<observer::SignalMake>()},
          {"laws", laws()}};
}

}  // namespace vigil
