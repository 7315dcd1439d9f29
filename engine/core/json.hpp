/// The one JSON type of the project. Ordered, because the order of lanes and nodes in a document is meaning
/// (colours, columns, the order of draws in a report), not decoration.
#pragma once

#include <nlohmann/json.hpp>

extern template class nlohmann::basic_json<nlohmann::ordered_map>;  // compiled once, in json.cpp

namespace vigil {

using Json = nlohmann::ordered_json;

}  // namespace vigil
