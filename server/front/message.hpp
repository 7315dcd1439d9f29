/// What a route sees of HTTP: a request that is complete and checked, and a response to fill in. No socket in it.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/input_error.hpp"
#include "engine/core/json.hpp"

namespace vigil {

/// Who asks: what the token (or its absence, where none is set) allows.
enum class Access { none, viewer, full };

/// A refusal. Thrown by a handler (or the front) and sent as application/problem+json.
class HttpError : public std::runtime_error {
 public:
  /// `detail` is one clear sentence for the user; `errors` go into the problem's "errors".
  HttpError(int status, const std::string& detail, std::vector<Problem> errors = {});
  int status() const { return status_; }
  const std::vector<Problem>& errors() const { return errors_; }
  /// Adds a response header, e.g. Retry-After or Allow. Returns *this, so that it can be thrown at once.
  HttpError& with_header(std::string name, std::string value);
  const std::vector<std::pair<std::string, std::string>>& headers() const { return headers_; }

 private:
  int status_;
  std::vector<Problem> errors_;
  std::vector<std::pair<std::string, std::string>> headers_;
};

/// RFC 9457: {"type":"about:blank","title","status","detail","errors":[{"pointer","detail","allowed"}]}; empty errors
/// left out.
Json problem_json(int status, const std::string& detail, const std::vector<Problem>& errors = {});
/// "Not Found" and so on; "Status" for a number that has no name here.
std::string_view status_title(int status);

struct HttpRequest {
  std::string id;      ///< of this request, in the log and in X-Request-Id
  std::string method;  ///< "GET", "POST", … ; a HEAD arrives as "GET"
  std::string path;    ///< as sent, without the query
  std::string body;    ///< whole
  std::string remote;  ///< the peer's address
  Access access = Access::full;
  std::map<std::string, std::string> params;                 ///< of the pattern, percent-decoded
  std::vector<std::pair<std::string, std::string>> query;    ///< decoded, in order
  std::vector<std::pair<std::string, std::string>> headers;  ///< as sent, in order

  /// The first header of that name (any case), or "".
  std::string header(std::string_view name) const;
  bool has_query(std::string_view name) const;
  /// The first query value of that name, or `otherwise`.
  std::string query_value(std::string_view name, std::string_view otherwise = "") const;
  /// As an integer within [lo, hi]. Throws HttpError 400 naming the parameter.
  std::int64_t query_int(std::string_view name, std::int64_t otherwise, std::int64_t lo, std::int64_t hi) const;
  /// A path parameter as a non-negative integer. Throws HttpError 404: no such thing can exist.
  std::int64_t id_param(std::string_view name) const;
  /// The body as JSON. Throws HttpError 400: malformed, deeper than 100 levels, duplicate keys, or not an object.
  Json json() const;
  /// True when the Accept header lists `type` (not by wildcard).
  bool accepts(std::string_view type) const;
  /// "application/json" of "application/json; charset=utf-8", in lower case.
  std::string content_type() const;
};

/// Writes a part of a streamed body; false when the client is gone: stop.
using BodyWriter = std::function<bool(std::string_view part)>;

struct HttpResponse {
  int status = 200;
  std::vector<std::pair<std::string, std::string>> headers;
  std::string content_type;
  std::string body;
  /// If set, called once on the worker to write the body in parts (chunked). An exception or false ends the connection,
  /// so that a cut body never looks whole.
  std::function<bool(const BodyWriter&)> stream;

  void set_header(std::string name, std::string value);
  void json(const Json& value, int code = 200);
  void text(std::string value, std::string type = "text/plain; charset=utf-8", int code = 200);
  /// 204, or another status without a body.
  void empty(int code = 204);
};

}  // namespace vigil
