#include "server/crew/crew.hpp"

namespace vigil {

Json to_json(const CrewMember& member) {
  return {
      {"name", member.name}, {"threads", member.threads}, {"refused", member.refused ? Json(*member.refused) : Json()}};
}

}  // namespace vigil
