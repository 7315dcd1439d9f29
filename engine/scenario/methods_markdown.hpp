/// docs/methods, made from the registries, the declared parameters and the words of engine/methods/words.hpp.
#pragma once

#include <map>
#include <string>

namespace vigil {

/// File name to text: README.md, the index, and one page a method, protection and detector. Throws std::logic_error
/// where a registered one has no words.
std::map<std::string, std::string> methods_markdown();

}  // namespace vigil
