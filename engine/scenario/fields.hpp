/// Reading the members of one object of the document: every member is known, typed and within range, or a problem.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/input_error.hpp"
#include "engine/core/json.hpp"

namespace vigil {

/// One object under its pointer. The readers return the value or the default; what is wrong is appended to the problems
/// and the default is returned, so that reading goes on and all problems are found.
class Fields {
 public:
  /// `given` and `problems` must outlive this. Anything but an object is a problem and reads as {}.
  Fields(const Json& given, std::string pointer, std::vector<Problem>& problems);

  /// Reports every key that is not among `known`.
  void known(const std::vector<std::string>& keys);
  bool has(std::string_view key) const;
  /// The member, or null where it is missing.
  const Json& at(std::string_view key) const;
  std::string pointer(std::string_view key) const;
  /// Appends a problem of a member: "<key> is <value>; expected <expected>".
  void wrong(std::string_view key, const std::string& expected);
  void missing(std::string_view key, const std::string& expected);

  Json text(std::string_view key, const Json& fallback);
  Json choice(std::string_view key, const std::vector<std::string>& choices, const Json& fallback);
  Json boolean(std::string_view key, bool fallback);
  Json integer(std::string_view key, const Json& fallback, std::int64_t minimum, bool nullable);
  /// A finite number > 0.
  Json positive(std::string_view key, const Json& fallback, bool nullable);
  /// A non-empty array of texts.
  Json texts(std::string_view key, const Json& fallback);

 private:
  const Json& given_;
  std::string pointer_;
  std::vector<Problem>& problems_;
};

/// True where every character passes and the length is between 1 and `longest`.
bool is_id(std::string_view text, std::size_t longest, const std::function<bool(char)>& allowed);
/// Ids of lanes and attacks: [a-z0-9_]{1,32}.
bool is_member_id(std::string_view text);
/// Ids of nodes: [A-Za-z0-9_]{1,16}.
bool is_node_id(std::string_view text);

}  // namespace vigil
