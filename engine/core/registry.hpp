/// What can be named in a document. A method, attack, plant or sensor is one file that ends with one line:
///   static const Registration<MethodFactory> registration({"consensus_ekf", {...title...}, "seed 000", table(),
///   make});
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/core/params.hpp"

namespace vigil {

/// What an entry of one kind declares beyond its parameters: specialised where there is something.
template <class Make>
struct Traits {};

/// One entry: Make is the type of the function that makes the object.
template <class Make>
struct Entry {
  std::string id;
  Words title;
  std::string source;  ///< "seed 000, sections 2 and 3"
  ParamTable params;
  Make make;
  Traits<Make> traits = {};
};

/// All entries of one kind, in the order of their ids (registration order depends on the linker, so it is not used).
template <class Make>
class Registry {
 public:
  static const std::vector<Entry<Make>>& all() { return entries(); }
  static const Entry<Make>* find(std::string_view id) {
    for (const auto& entry : entries()) {
      if (entry.id == id) return &entry;
    }
    return nullptr;
  }
  static std::vector<std::string> ids() {
    std::vector<std::string> result;
    for (const auto& entry : entries()) result.push_back(entry.id);
    return result;
  }
  static void add(Entry<Make> entry) {
    auto& list = entries();
    auto place = list.begin();
    while (place != list.end() && place->id < entry.id) ++place;
    list.insert(place, std::move(entry));
  }

 private:
  static std::vector<Entry<Make>>& entries() {
    static std::vector<Entry<Make>> list;
    return list;
  }
};

template <class Make>
struct Registration {
  explicit Registration(Entry<Make> entry) { Registry<Make>::add(std::move(entry)); }
};

}  // namespace vigil
