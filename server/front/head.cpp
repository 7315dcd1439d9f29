#include "server/front/head.hpp"

#include <algorithm>

#include "server/front/header_text.hpp"

namespace vigil {
namespace {

bool starts_with_name(std::string_view text, std::string_view prefix) {
  return text.size() >= prefix.size() && same_name(text.substr(0, prefix.size()), prefix);
}

bool is_token_char(char c) {
  const bool alphanumeric = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  return alphanumeric || (c != '\0' && std::string_view("!#$%&'*+-.^_`|~").find(c) != std::string_view::npos);
}

bool is_token(std::string_view text) { return !text.empty() && std::all_of(text.begin(), text.end(), is_token_char); }

bool is_control(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte < 0x20 || byte == 0x7f;
}

bool has_option(std::string_view list, std::string_view option) {
  while (!list.empty()) {
    const auto comma = list.find(',');
    if (same_name(trim(list.substr(0, comma)), option)) return true;
    list = comma == std::string_view::npos ? std::string_view() : list.substr(comma + 1);
  }
  return false;
}

Refusal refuse(int status, std::string detail) { return {status, std::move(detail)}; }

Refusal parse_target(std::string_view target, Head& head) {
  if (target.empty() || target.front() != '/')
    return refuse(400, "The request's target must be a path that begins with '/'.");
  for (const char c : target) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte <= 0x20 || byte >= 0x7f || c == '#' || c == '\\') {
      return refuse(400, "The request's target holds a character that must be percent-encoded.");
    }
  }
  const auto mark = target.find('?');
  head.target = target;
  head.path = target.substr(0, mark);
  head.query = mark == std::string_view::npos ? std::string_view() : target.substr(mark + 1);
  return {};
}

Refusal parse_request_line(std::string_view line, Head& head) {
  const auto first = line.find(' ');
  const auto last = line.rfind(' ');
  const std::string_view method = line.substr(0, first);
  if (first == std::string_view::npos || first == last || !is_token(method) || method.size() > 16) {
    return refuse(400, "The request line must be a method, a path and a version, one space between them.");
  }
  const std::string_view version = line.substr(last + 1);
  if (version != "HTTP/1.1" && version != "HTTP/1.0") {
    const bool other = version.starts_with("HTTP/") && version.size() == 8;
    return other ? refuse(505, "This server speaks HTTP/1.1 and HTTP/1.0.")
                 : refuse(400, "The request line must end with HTTP/1.1.");
  }
  head.method = method;
  head.keep_alive = version == "HTTP/1.1";
  return parse_target(line.substr(first + 1, last - first - 1), head);
}

Refusal parse_length(std::string_view value, Head& head) {
  if (head.content_length) return refuse(400, "Content-Length is given twice.");
  const bool digits = !value.empty() && value.size() <= 15 &&
                      std::all_of(value.begin(), value.end(), [](char c) { return c >= '0' && c <= '9'; });
  if (!digits) return refuse(400, "Content-Length must be a whole number of bytes.");
  std::uint64_t length = 0;
  for (const char c : value) length = length * 10 + static_cast<std::uint64_t>(c - '0');
  head.content_length = length;
  return {};
}

Refusal take_host(std::string_view value, Head& head) {
  if (!head.host.empty()) return refuse(400, "Host is given twice.");
  if (value.empty()) return refuse(421, "Host is empty.");
  head.host = value;
  return {};
}

/// What a field means to the door itself.
Refusal take_meaning(std::string_view name, std::string_view value, Head& head) {
  if (starts_with_name(name, "REMOTE_") || starts_with_name(name, "LOCAL_")) {
    return refuse(400, "Header fields named REMOTE_… or LOCAL_… are not taken.");
  }
  if (same_name(name, "Transfer-Encoding"))
    return refuse(411, "Transfer-Encoding is not taken: send the body with a Content-Length.");
  if (same_name(name, "Content-Encoding")) return refuse(415, "Content-Encoding is not taken: send the body as it is.");
  if (same_name(name, "Content-Length")) return parse_length(value, head);
  if (same_name(name, "Host")) return take_host(value, head);
  if (same_name(name, "Expect")) head.expects_continue = same_name(value, "100-continue");
  if (same_name(name, "Connection")) {
    if (has_option(value, "close")) head.keep_alive = false;
    // HTTP/1.0 clients that ask to stay are answered and closed all the same: allowed, and simpler.
  }
  return {};
}

Refusal parse_field(std::string_view line, Head& head) {
  if (line.front() == ' ' || line.front() == '\t')
    return refuse(400, "A header field must not go on over several lines.");
  const auto colon = line.find(':');
  if (colon == std::string_view::npos || !is_token(line.substr(0, colon))) {
    return refuse(400, "A header field must be a name, a colon and a value.");
  }
  const std::string_view name = line.substr(0, colon);
  const std::string_view value = trim(line.substr(colon + 1));
  if (std::any_of(value.begin(), value.end(), [](char c) { return is_control(c) && c != '\t'; })) {
    return refuse(400, "The header field " + std::string(name) + " holds a control character.");
  }
  head.fields.emplace_back(name, value);
  return take_meaning(name, value, head);
}

}  // namespace

std::string_view Head::field(std::string_view name) const {
  for (const auto& [key, value] : fields) {
    if (same_name(key, name)) return value;
  }
  return {};
}

std::size_t HeadScan::scan(std::string_view in, const HeadLimits& limits, Refusal& refusal) {
  if (seen_ == 0 && !in.empty() && !is_token_char(in.front())) {
    refusal = refuse(400, "This is not an HTTP request.");
    return 0;
  }
  for (; seen_ < in.size(); ++seen_) {
    const std::size_t length = seen_ + 1;
    if (length > limits.bytes) {
      refusal = refuse(431, "The request's header fields are longer than 16 kB in all.");
      return 0;
    }
    if (in[seen_] == '\n') {
      const bool blank = seen_ - line_start_ == 1 && in[line_start_] == '\r';
      if (blank && first_line_done_) return length;
      first_line_done_ = true;
      line_start_ = length;
    } else if (length - line_start_ > limits.line) {
      refusal = first_line_done_ ? refuse(431, "A header field is longer than 8 kB.")
                                 : refuse(414, "The request's target is longer than 8 kB.");
      return 0;
    }
  }
  return 0;
}

Refusal parse_head(std::string_view bytes, const HeadLimits& limits, Head& head) {
  head = Head();
  if (bytes.size() > limits.bytes) return refuse(431, "The request's header fields are longer than 16 kB in all.");
  bool first = true;
  while (!bytes.empty()) {
    const auto end = bytes.find('\n');
    if (end == std::string_view::npos || end == 0 || bytes[end - 1] != '\r')
      return refuse(400, "A line of the request's head must end with CR LF.");
    const std::string_view line = bytes.substr(0, end - 1);
    bytes.remove_prefix(end + 1);
    if (line.size() > limits.line)
      return first ? refuse(414, "The request's target is longer than 8 kB.")
                   : refuse(431, "A header field is longer than 8 kB.");
    if (line.empty()) {
      if (first || !bytes.empty()) return refuse(400, "The request's head is cut short.");
      if (head.host.empty()) return refuse(421, "Host is missing.");
      return {};
    }
    if (!first && head.fields.size() == limits.fields)
      return refuse(431, "The request has more than 64 header fields.");
    const Refusal refusal = first ? parse_request_line(line, head) : parse_field(line, head);
    if (refusal) return refusal;
    first = false;
  }
  return refuse(400, "The request's head is cut short.");
}

}  // namespace vigil
