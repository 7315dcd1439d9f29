/// The scenario document: presets, validation, schema. The contract, section 2.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/core/input_error.hpp"
#include "engine/core/json.hpp"

namespace vigil {

/// A validated document, with every default filled in.
class Scenario {
 public:
  /// Validates a whole document. Throws InputError with every problem found: unknown keys (with the nearest valid one),
  /// types, ranges, non-finite numbers.
  static Scenario from_json(const Json& document);
  /// A preset by its id. Throws InputError that lists the presets.
  static Scenario preset(std::string_view id);
  static const std::vector<std::string>& preset_ids();
  static bool is_preset(std::string_view id);

  const Json& document() const { return document_; }
  std::string id() const;
  std::string family() const;

  /// A copy with a JSON Merge Patch (RFC 7396) applied and validated again.
  Scenario patched(const Json& merge_patch) const;
  /// A copy with one dotted path set ("lanes.consensus.params.tau"). Throws InputError where the path leads nowhere.
  Scenario with(std::string_view dotted_path, const Json& value) const;

  /// JSON Schema (draft 2020-12) of documents like this one: the plant's, sensors', attacks' and methods' declared
  /// parameters with titles in English and, under "x-zh", Chinese; "x-unit", "x-symbol", "x-live", "x-source" beside
  /// them.
  Json schema() const;

 private:
  Json document_;
};

/// The registry as JSON for `vigil methods` and GET /methods:
/// {"methods":[…],"attacks":[…],"plants":[…],"sensors":[…],"laws":[…]}, each with id, title {en,zh}, source, parameters
/// [{name,type,unit,default,minimum,maximum,choices,live,symbol,meaning{en,zh}}].
Json registry_json();

/// The version of Vigil, recorded with every run.
std::string_view version();

}  // namespace vigil
