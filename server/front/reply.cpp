#include "server/front/reply.hpp"

namespace vigil {
namespace {

void append(std::string& out, std::string_view name, std::string_view value) {
  out.append(name).append(": ").append(value).append("\r\n");
}

std::string status_line(int status) {
  return "HTTP/1.1 " + std::to_string(status) + " " + std::string(status_title(status)) + "\r\n";
}

}  // namespace

const HeaderList& security_headers() {
  static const HeaderList list = {
      {"Content-Security-Policy",
       "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; img-src 'self' data:; font-src "
       "'self'; "
       "worker-src 'self'; manifest-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"},
      {"X-Content-Type-Options", "nosniff"},
      {"Referrer-Policy", "no-referrer"},
      {"Cross-Origin-Opener-Policy", "same-origin"},
      {"Cross-Origin-Resource-Policy", "same-origin"},
      {"X-Frame-Options", "DENY"},
      {"Permissions-Policy", "camera=(), microphone=(), geolocation=()"}};
  return list;
}

std::string raw_reply(int status, const HeaderList& headers, std::string_view content_type, std::string_view body,
                      bool keep_alive) {
  std::string out = status_line(status);
  for (const auto& [name, value] : security_headers()) append(out, name, value);
  append(out, "Cache-Control", "no-store");
  for (const auto& [name, value] : headers) append(out, name, value);
  if (!content_type.empty()) append(out, "Content-Type", content_type);
  if (status != 204) append(out, "Content-Length", std::to_string(body.size()));
  append(out, "Connection", keep_alive ? "keep-alive" : "close");
  return out.append("\r\n").append(body);
}

std::string raw_problem(int status, const std::string& detail, const HeaderList& headers, bool keep_alive,
                        bool head_only) {
  const std::string body = problem_json(status, detail).dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string out = raw_reply(status, headers, "application/problem+json", body, keep_alive);
  if (head_only) out.resize(out.size() - body.size());
  return out;
}

std::string stream_head() {
  std::string out = status_line(200);
  for (const auto& [name, value] : security_headers()) append(out, name, value);
  append(out, "Content-Type", "text/event-stream");
  append(out, "Cache-Control", "no-store");
  append(out, "X-Accel-Buffering", "no");
  append(out, "Connection", "close");
  append(out, "Transfer-Encoding", "chunked");
  return out.append("\r\n");
}

}  // namespace vigil
