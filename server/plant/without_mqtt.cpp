// In place of server/mqtt/, where the library was not there or not wanted.
#include <stdexcept>

#include "server/plant/mqtt.hpp"

namespace vigil {

std::string mqtt_missing() {
  return "this vigil was built without MQTT; install libpaho-mqttpp-dev and libpaho-mqtt-dev and build it with "
         "-DVIGIL_MQTT=ON";
}

void check_mqtt(const MqttOptions&) { throw std::runtime_error(mqtt_missing()); }

std::unique_ptr<PlantLink> open_plant_link(const MqttOptions&, PlantInbox&) {
  throw std::runtime_error(mqtt_missing());
}

std::unique_ptr<AlarmSink> open_mqtt_alarms(const MqttOptions&) { throw std::runtime_error(mqtt_missing()); }

}  // namespace vigil
