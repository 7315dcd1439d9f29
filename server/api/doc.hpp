/// Short ways to write the OpenAPI side of a route.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "engine/core/json.hpp"

namespace vigil::doc {

Json text_schema(const std::string& description = {});
Json integer_schema(std::int64_t minimum, std::int64_t maximum);
/// An object with these properties, no others.
Json object_schema(std::vector<std::pair<std::string, Json>> properties, const std::vector<std::string>& required = {});
/// {"items":[item],"next":text or null}
Json page_schema(Json item);

Json query(const std::string& name, Json schema, const std::string& description);
Json header(const std::string& name, const std::string& description);

/// An operation, built part by part; what() is merged into the route's OpenAPI entry.
class Operation {
 public:
  Operation& parameter(Json parameter);
  Operation& body(Json schema, const std::string& type = "application/json");
  Operation& answer(int code, const std::string& description, Json schema,
                    const std::string& type = "application/json");
  Operation& empty(int code, const std::string& description);
  /// A problem that this route in particular can answer with.
  Operation& problem(int code, const std::string& description);
  Json what() const { return json_; }

 private:
  Json json_ = Json::object();
};

}  // namespace vigil::doc
