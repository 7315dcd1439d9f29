/// The table of routes: what the front dispatches on and what OpenAPI is made from.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/json.hpp"
#include "server/front/message.hpp"

namespace vigil {

using Handler = std::function<void(const HttpRequest&, HttpResponse&)>;

/// Which topic of the hub a stream route opens. No run: the global feed.
struct StreamTarget {
  std::optional<std::int64_t> run;
  std::string topic;
};

struct Route {
  std::string method;   ///< "GET", "POST", "PUT", "PATCH", "DELETE"; HEAD and OPTIONS come by themselves
  std::string pattern;  ///< "/api/v1/runs/{id}/samples": a {name} matches one whole, non-empty segment
  /// Runs on a worker. Throws HttpError, InputError (-> 422); anything else becomes a 500 without its text.
  Handler handler;
  std::string summary;        ///< one line for OpenAPI
  Json doc = Json::object();  ///< further OpenAPI fields of the operation, merged in as they are

  bool open = false;  ///< no token needed (health, session, the page)
  /// What a body may be. Empty: this route takes no body at all (then no Content-Type is asked for).
  std::vector<std::string> body_types = {"application/json"};
  std::size_t body_limit = 0;  ///< bytes; 0: the front's own
  /// Set: GET answers with the hub's stream. Called on the loop's thread: must not block; may throw HttpError. If the
  /// hub does not know the run, `handler` is called on a worker to say 204 (it has ended) or 404.
  std::function<StreamTarget(const HttpRequest&)> stream;
};

class Routes {
 public:
  /// Throws std::invalid_argument if method and pattern are taken.
  void add(Route route);
  struct Match {
    const Route* route = nullptr;               ///< null: see allowed
    std::map<std::string, std::string> params;  ///< decoded
    std::vector<std::string> allowed;           ///< methods the path knows; empty: unknown path
  };
  /// A literal segment wins over a parameter. HEAD matches GET. A segment that is not valid percent-encoded UTF-8, or
  /// that holds a control character or an encoded slash, matches no parameter.
  Match match(std::string_view method, std::string_view path) const;
  const std::vector<Route>& all() const { return routes_; }

 private:
  std::vector<Route> routes_;
  std::vector<std::vector<std::string>> segments_;
};

/// Percent-decodes; nullopt on a bad escape, a control character, or bytes that are not UTF-8. plus: '+' means a space.
std::optional<std::string> percent_decode(std::string_view text, bool plus);

}  // namespace vigil
