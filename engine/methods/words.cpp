#include "engine/methods/words.hpp"

#include <utility>

namespace vigil {
namespace {

std::vector<FamilyWords>& list() {
  static std::vector<FamilyWords> all;
  return all;
}

}  // namespace

WordsRegistration::WordsRegistration(const std::string& family, std::vector<MethodWords> words) {
  for (MethodWords& one : words) {
    auto place = list().begin();
    while (place != list().end() && place->words.id < one.id) ++place;
    list().insert(place, {family, std::move(one)});
  }
}

const std::vector<FamilyWords>& method_words() { return list(); }

const FamilyWords* find_words(std::string_view id) {
  for (const FamilyWords& one : list()) {
    if (one.words.id == id) return &one;
  }
  return nullptr;
}

}  // namespace vigil
