#include "server/front/door.hpp"

#include <strings.h>

#include <algorithm>

namespace vigil {
namespace {

std::string lower(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

bool is_state_changing(std::string_view method) { return method != "GET" && method != "HEAD" && method != "OPTIONS"; }

bool has_body(std::string_view method) { return method == "POST" || method == "PUT" || method == "PATCH"; }

std::string join(const std::vector<std::string>& words, std::string_view between) {
  std::string out;
  for (const auto& word : words) out.append(out.empty() ? "" : between).append(word);
  return out;
}

std::string allow_list(std::vector<std::string> methods) {
  if (std::find(methods.begin(), methods.end(), "GET") != methods.end()) methods.push_back("HEAD");
  methods.push_back("OPTIONS");
  return join(methods, ", ");
}

/// The type itself, without parameters, in lower case.
std::string media_type(std::string_view value) {
  std::string type = lower(value.substr(0, value.find(';')));
  while (!type.empty() && type.back() == ' ') type.pop_back();
  return type;
}

}  // namespace

std::string host_name(std::string_view host) {
  if (host.starts_with('[')) {
    const auto end = host.find(']');
    if (end == std::string_view::npos) return {};
    const std::string_view rest = host.substr(end + 1);
    if (!rest.empty() && rest.front() != ':') return {};
    return lower(host.substr(1, end - 1));
  }
  const auto colon = host.find(':');
  if (colon != std::string_view::npos) {
    const std::string_view port = host.substr(colon + 1);
    if (!std::all_of(port.begin(), port.end(), [](char c) { return c >= '0' && c <= '9'; })) return {};
  }
  return lower(host.substr(0, colon));
}

Door::Door(std::string host, std::vector<std::string> allow_hosts, std::size_t body_limit, const Routes& routes,
           const StaticFiles& files, const Doorkeeper& keeper)
    : hosts_{"localhost", "127.0.0.1", "::1"},
      body_limit_(body_limit),
      routes_(routes),
      files_(files),
      keeper_(keeper) {
  if (host != "0.0.0.0" && host != "::" && !host.empty()) hosts_.push_back(lower(host));
  for (const auto& name : allow_hosts) hosts_.push_back(lower(name));
}

bool Door::host_allowed(std::string_view host, std::string_view local) const {
  const std::string name = host_name(host);
  if (name.empty()) return false;
  // A page of another site can make its own name point here (DNS rebinding), but never an address.
  return name == local || std::find(hosts_.begin(), hosts_.end(), name) != hosts_.end();
}

Pass Door::check(const Head& head, std::string_view local) const {
  Pass pass;
  if (!host_allowed(head.host, local)) {
    refuse(pass, 421, "This server does not answer for the host \"" + head.host + "\": see --allow-host.");
    return pass;
  }
  pass.match = routes_.match(head.method, head.path);
  pass.body_limit = body_limit_;
  using Check = void (Door::*)(const Head&, Pass&) const;
  for (const Check each : {&Door::check_identity, &Door::check_method, &Door::check_origin, &Door::check_body}) {
    if (pass.options) break;
    (this->*each)(head, pass);
    if (pass.refusal) break;
  }
  return pass;
}

void Door::check_identity(const Head& head, Pass& pass) const {
  pass.access = keeper_.access(head.field("authorization"), head.field("cookie"));
  const bool page = pass.match.allowed.empty() && files_.has(head.path);
  const bool open = page || (pass.match.route && pass.match.route->open);
  if (pass.access == Access::none && !open) {
    pass.headers.emplace_back("WWW-Authenticate", "Bearer realm=\"vigil\"");
    refuse(pass, 401, "This server asks for a token: send it as \"Authorization: Bearer …\".");
    return;
  }
  const bool own_session = pass.match.route && pass.match.route->open;
  if (pass.access == Access::viewer && is_state_changing(head.method) && !own_session) {
    refuse(pass, 403, "This token is for viewing only: it cannot change anything.");
  }
}

void Door::check_method(const Head& head, Pass& pass) const {
  if (pass.match.allowed.empty()) {
    if (!files_.has(head.path)) {
      refuse(pass, 404, "There is nothing at " + head.path + ".");
      return;
    }
    pass.match.allowed = {"GET"};
    if (head.method == "GET" || head.method == "HEAD") return;
  }
  if (head.method == "OPTIONS") {
    pass.options = true;
    pass.headers.emplace_back("Allow", allow_list(pass.match.allowed));
  } else if (!pass.match.route || (head.method == "HEAD" && pass.match.route->stream)) {
    pass.headers.emplace_back("Allow", allow_list(pass.match.allowed));
    refuse(pass, 405, "The method " + head.method + " is not known at " + head.path + ".");
  }
}

void Door::check_origin(const Head& head, Pass& pass) const {
  const bool stream = pass.match.route && pass.match.route->stream;
  if (!is_state_changing(head.method) && !stream) return;
  const std::string_view origin = head.field("origin");
  const std::string host = lower(head.host);
  const std::string sent = lower(origin);
  const bool ours = origin.empty() || sent == "http://" + host || sent == "https://" + host;
  if (!ours) refuse(pass, 403, "A page of another origin (" + std::string(origin) + ") may not call this.");
}

void Door::check_body(const Head& head, Pass& pass) const {
  const Route* route = pass.match.route;
  const std::uint64_t length = head.content_length.value_or(0);
  if (!route || !is_state_changing(head.method)) {
    if (length > 0) refuse(pass, 400, "A " + head.method + " request takes no body.");
    return;
  }
  if (route->body_types.empty()) {
    if (length > 0) refuse(pass, 400, "This call takes no body.");
    return;
  }
  if (length == 0 && !has_body(head.method)) return;
  const std::string type = media_type(head.field("content-type"));
  if (std::find(route->body_types.begin(), route->body_types.end(), type) == route->body_types.end()) {
    refuse(pass, 415, "The Content-Type is \"" + type + "\", but must be " + join(route->body_types, " or ") + ".");
    return;
  }
  if (!head.content_length) {
    refuse(pass, 411, "This call needs a Content-Length.");
    return;
  }
  if (route->body_limit > 0) pass.body_limit = route->body_limit;
  if (length > pass.body_limit) {
    refuse(pass, 413,
           "The body has " + std::to_string(length) + " bytes; this call takes at most " +
               std::to_string(pass.body_limit) + ".");
  }
}

}  // namespace vigil
