#include "server/api/doc.hpp"

namespace vigil::doc {

Json text_schema(const std::string& description) {
  Json schema{{"type", "string"}};
  if (!description.empty()) schema["description"] = description;
  return schema;
}

Json integer_schema(std::int64_t minimum, std::int64_t maximum) {
  return {{"type", "integer"}, {"minimum", minimum}, {"maximum", maximum}};
}

Json object_schema(std::vector<std::pair<std::string, Json>> properties, const std::vector<std::string>& required) {
  Json schema{{"type", "object"}, {"additionalProperties", false}, {"properties", Json::object()}};
  for (auto& [name, property] : properties) schema["properties"][name] = std::move(property);
  if (!required.empty()) schema["required"] = required;
  return schema;
}

Json page_schema(Json item) {
  Json items{{"type", "array"}, {"items", std::move(item)}};
  return {{"type", "object"},
          {"required", {"items", "next"}},
          {"properties", {{"items", std::move(items)}, {"next", {{"type", {"string", "null"}}}}}}};
}

Json query(const std::string& name, Json schema, const std::string& description) {
  return {{"name", name},
          {"in", "query"},
          {"required", false},
          {"description", description},
          {"schema", std::move(schema)}};
}

Json header(const std::string& name, const std::string& description) {
  return {{"name", name},
          {"in", "header"},
          {"required", false},
          {"description", description},
          {"schema", {{"type", "string"}}}};
}

Operation& Operation::parameter(Json parameter) {
  json_["parameters"].push_back(std::move(parameter));
  return *this;
}

Operation& Operation::body(Json schema, const std::string& type) {
  json_["requestBody"]["required"] = true;
  json_["requestBody"]["content"][type]["schema"] = std::move(schema);
  return *this;
}

Operation& Operation::answer(int code, const std::string& description, Json schema, const std::string& type) {
  Json& response = json_["responses"][std::to_string(code)];
  response["description"] = description;
  response["content"][type]["schema"] = std::move(schema);
  return *this;
}

Operation& Operation::empty(int code, const std::string& description) {
  json_["responses"][std::to_string(code)]["description"] = description;
  return *this;
}

Operation& Operation::problem(int code, const std::string& description) {
  Json& response = json_["responses"][std::to_string(code)];
  response["description"] = description;
  response["content"]["application/problem+json"]["schema"] = {{"$ref", "#/components/schemas/Problem"}};
  return *this;
}

}  // namespace vigil::doc
