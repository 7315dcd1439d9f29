#include "server/api/openapi.hpp"

#include <algorithm>
#include <cctype>

#include "engine/scenario/scenario.hpp"

namespace vigil {
namespace {

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// getApiV1RunsIdSamples
std::string operation_id(const Route& route) {
  std::string id = lower(route.method);
  bool upper = true;
  for (const char c : route.pattern) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) {
      upper = true;
    } else {
      id += upper ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
      upper = false;
    }
  }
  return id;
}

Json path_parameters(const std::string& pattern) {
  Json parameters = Json::array();
  for (std::size_t open = pattern.find('{'); open != std::string::npos; open = pattern.find('{', open + 1)) {
    const std::size_t close = pattern.find('}', open);
    parameters.push_back({{"name", pattern.substr(open + 1, close - open - 1)},
                          {"in", "path"},
                          {"required", true},
                          {"schema", {{"type", "string"}}}});
  }
  return parameters;
}

Json problem_response(const std::string& description) {
  return {{"description", description},
          {"content", {{"application/problem+json", {{"schema", {{"$ref", "#/components/schemas/Problem"}}}}}}}};
}

Json problem_schema() {
  Json text{{"type", "string"}};
  Json error{{"type", "object"}, {"properties", {{"pointer", text}, {"detail", text}, {"allowed", text}}}};
  return {{"type", "object"},
          {"required", {"type", "title", "status", "detail"}},
          {"properties",
           {{"type", text},
            {"title", text},
            {"status", {{"type", "integer"}}},
            {"detail", text},
            {"errors", {{"type", "array"}, {"items", error}}}}}};
}

void add_bodies(const Route& route, Json& operation) {
  const bool writes = route.method != "GET" && route.method != "DELETE";
  if (!writes || route.body_types.empty() || operation.contains("requestBody")) return;
  for (const std::string& type : route.body_types) operation["requestBody"]["content"][type]["schema"] = Json::object();
}

Json operation(const Route& route) {
  Json result;
  result["operationId"] = operation_id(route);
  result["summary"] = route.summary;
  Json parameters = path_parameters(route.pattern);
  Json responses = Json::object();
  for (const auto& [key, value] : route.doc.items()) {
    if (key == "parameters") {
      for (const Json& parameter : value) parameters.push_back(parameter);
    } else if (key == "responses") {
      responses = value;
    } else {
      result[key] = value;
    }
  }
  if (responses.empty()) responses["200"] = {{"description", "Done."}};
  if (!route.open && !responses.contains("401")) responses["401"] = problem_response("A token is asked for.");
  responses["default"] = problem_response("What was wrong with the request, or why it cannot be served now.");
  result["parameters"] = std::move(parameters);
  add_bodies(route, result);
  result["responses"] = std::move(responses);
  if (route.open) result["security"] = Json::array();
  return result;
}

}  // namespace

Json openapi_json(const Routes& routes) {
  Json api;
  api["openapi"] = "3.1.0";
  api["info"] = {{"title", "Vigil"},
                 {"version", std::string(version())},
                 {"license", {{"name", "Apache-2.0"}, {"identifier", "Apache-2.0"}}},
                 {"description", "Secure state estimation under attack: scenarios, runs, their samples and streams."}};
  api["servers"] = Json::array({{{"url", "/"}}});
  api["security"] = Json::array({{{"bearer", Json::array()}}, {{"session", Json::array()}}});
  api["paths"] = Json::object();
  for (const Route& route : routes.all()) {
    api["paths"][route.pattern][lower(route.method)] = operation(route);
  }
  api["components"]["schemas"]["Problem"] = problem_schema();
  api["components"]["securitySchemes"]["bearer"] = {{"type", "http"}, {"scheme", "bearer"}};
  api["components"]["securitySchemes"]["session"] = {{"type", "apiKey"}, {"in", "cookie"}, {"name", "vigil_session"}};
  return api;
}

}  // namespace vigil
