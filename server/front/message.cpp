#include "server/front/message.hpp"

#include <algorithm>
#include <charconv>
#include <set>

#include "engine/core/describe.hpp"
#include "server/front/header_text.hpp"

namespace vigil {
namespace {

constexpr int kDeepestJson = 100;

std::string lower(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

/// Watches a parse for what the library lets pass: depth and keys given twice.
class StrictParse {
 public:
  bool operator()(int depth, Json::parse_event_t event, Json& parsed) {
    using Event = Json::parse_event_t;
    if (depth > kDeepestJson) throw HttpError(400, "The body is nested deeper than 100 levels.");
    if (event == Event::object_start) {
      keys_.emplace_back();
    } else if (event == Event::object_end) {
      keys_.pop_back();
    } else if (event == Event::key && !keys_.back().insert(parsed.get<std::string>()).second) {
      throw HttpError(400, "The body gives the key \"" + parsed.get<std::string>() + "\" twice in one object.");
    }
    return true;
  }

 private:
  std::vector<std::set<std::string>> keys_;
};

/// What nlohmann says, without its "[json.exception.…]".
std::string parse_sentence(const std::string& what) {
  const auto end = what.find("] ");
  if (!is_utf8(what)) return "The body is not valid JSON.";  // it quotes half a letter
  return "The body is not valid JSON: " + (end == std::string::npos ? what : what.substr(end + 2)) + ".";
}

}  // namespace

HttpError::HttpError(int status, const std::string& detail, std::vector<Problem> errors)
    : std::runtime_error(detail), status_(status), errors_(std::move(errors)) {}

HttpError& HttpError::with_header(std::string name, std::string value) {
  headers_.emplace_back(std::move(name), std::move(value));
  return *this;
}

std::string_view status_title(int status) {
  static const std::map<int, std::string_view> titles = {{100, "Continue"},
                                                         {200, "OK"},
                                                         {201, "Created"},
                                                         {202, "Accepted"},
                                                         {204, "No Content"},
                                                         {304, "Not Modified"},
                                                         {400, "Bad Request"},
                                                         {401, "Unauthorized"},
                                                         {403, "Forbidden"},
                                                         {404, "Not Found"},
                                                         {405, "Method Not Allowed"},
                                                         {406, "Not Acceptable"},
                                                         {408, "Request Timeout"},
                                                         {409, "Conflict"},
                                                         {410, "Gone"},
                                                         {411, "Length Required"},
                                                         {412, "Precondition Failed"},
                                                         {413, "Content Too Large"},
                                                         {414, "URI Too Long"},
                                                         {415, "Unsupported Media Type"},
                                                         {421, "Misdirected Request"},
                                                         {422, "Unprocessable Content"},
                                                         {428, "Precondition Required"},
                                                         {429, "Too Many Requests"},
                                                         {431, "Request Header Fields Too Large"},
                                                         {500, "Internal Server Error"},
                                                         {501, "Not Implemented"},
                                                         {503, "Service Unavailable"},
                                                         {505, "HTTP Version Not Supported"}};
  const auto found = titles.find(status);
  return found == titles.end() ? "Status" : found->second;
}

Json problem_json(int status, const std::string& detail, const std::vector<Problem>& errors) {
  Json problem;
  problem["type"] = "about:blank";
  problem["title"] = status_title(status);
  problem["status"] = status;
  problem["detail"] = detail;
  if (errors.empty()) return problem;
  Json list = Json::array();
  for (const Problem& error : errors) {
    Json item;
    item["pointer"] = error.pointer;
    item["detail"] = error.detail;
    if (!error.allowed.empty()) item["allowed"] = error.allowed;
    list.push_back(std::move(item));
  }
  problem["errors"] = std::move(list);
  return problem;
}

std::string HttpRequest::header(std::string_view name) const {
  for (const auto& [key, value] : headers) {
    if (same_name(key, name)) return value;
  }
  return {};
}

bool HttpRequest::has_query(std::string_view name) const {
  return std::any_of(query.begin(), query.end(), [&](const auto& each) { return each.first == name; });
}

std::string HttpRequest::query_value(std::string_view name, std::string_view otherwise) const {
  for (const auto& [key, value] : query) {
    if (key == name) return value;
  }
  return std::string(otherwise);
}

std::int64_t HttpRequest::query_int(std::string_view name, std::int64_t otherwise, std::int64_t lo,
                                    std::int64_t hi) const {
  if (!has_query(name)) return otherwise;
  const std::string text = query_value(name);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc() && end == text.data() + text.size() && value >= lo && value <= hi) return value;
  const std::string range = std::to_string(lo) + " to " + std::to_string(hi);
  const std::string detail =
      "The query parameter " + std::string(name) + " is \"" + text + "\", but must be an integer from " + range + ".";
  throw HttpError(400, detail, {{"/query/" + std::string(name), detail, range}});
}

std::int64_t HttpRequest::id_param(std::string_view name) const {
  const auto found = params.find(std::string(name));
  const std::string text = found == params.end() ? std::string() : found->second;
  std::int64_t value = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc() && end == text.data() + text.size() && value >= 0) return value;
  throw HttpError(404, "There is no \"" + text + "\" here: ids are whole numbers.");
}

Json HttpRequest::json() const {
  StrictParse watch;
  Json value;
  try {
    value = Json::parse(
        body, [&](int depth, Json::parse_event_t event, Json& parsed) { return watch(depth, event, parsed); });
  } catch (const Json::exception& error) {
    throw HttpError(400, parse_sentence(error.what()));
  }
  if (!value.is_object()) throw HttpError(400, "The body must be a JSON object.");
  return value;
}

bool HttpRequest::accepts(std::string_view type) const {
  const std::string header_value = header("accept");
  std::string_view list = header_value;
  while (!list.empty()) {
    const auto comma = list.find(',');
    std::string_view item = list.substr(0, comma);
    list = comma == std::string_view::npos ? std::string_view() : list.substr(comma + 1);
    if (same_name(trim(item.substr(0, item.find(';'))), type)) return true;
  }
  return false;
}

std::string HttpRequest::content_type() const {
  const std::string value = header("content-type");
  return lower(trim(std::string_view(value).substr(0, value.find(';'))));
}

void HttpResponse::set_header(std::string name, std::string value) {
  headers.emplace_back(std::move(name), std::move(value));
}

void HttpResponse::json(const Json& value, int code) {
  status = code;
  content_type = "application/json";
  body = value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void HttpResponse::text(std::string value, std::string type, int code) {
  status = code;
  content_type = std::move(type);
  body = std::move(value);
}

void HttpResponse::empty(int code) {
  status = code;
  content_type.clear();
  body.clear();
}

}  // namespace vigil
