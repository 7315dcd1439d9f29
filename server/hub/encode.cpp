#include "server/hub/encode.hpp"

#include <array>
#include <charconv>
#include <cmath>

namespace vigil {
namespace {

void append_integer(std::string& out, std::int64_t value) {
  std::array<char, 24> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  out.append(text.data(), end);
}

void append_general(std::string& out, double value, int digits) {
  std::array<char, 40> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, digits).ptr;
  out.append(text.data(), end);
}

void append_time(std::string& out, double t) {
  if (std::isfinite(t)) {
    append_general(out, t, 12);
  } else {
    out += "null";
  }
}

}  // namespace

void append_number(std::string& out, double value) {
  if (!std::isfinite(value)) {
    out += "null";
    return;
  }
  // Most signals are flags, states and counters: the integer path is several times faster.
  if (std::abs(value) < 1e6) {
    const auto whole = static_cast<std::int64_t>(value);
    if (static_cast<double>(whole) == value) {
      append_integer(out, whole);
      return;
    }
  }
  append_general(out, value, 6);
}

std::string as_chunk(std::string_view payload) {
  std::array<char, 20> size;
  const auto end = std::to_chars(size.data(), size.data() + size.size(), payload.size(), 16).ptr;
  std::string out;
  out.reserve(payload.size() + 24);
  out.append(size.data(), end).append("\r\n").append(payload).append("\r\n");
  return out;
}

Packet encode_event(std::string_view event, std::string_view data, std::string_view id) {
  std::string text;
  text.reserve(event.size() + data.size() + id.size() + 32);
  if (!id.empty()) text.append("id: ").append(id).append("\n");
  text.append("event: ").append(event).append("\ndata: ").append(data).append("\n\n");
  return std::make_shared<const std::string>(as_chunk(text));
}

Packet encode_frame(std::string_view epoch, std::int64_t k, double t, std::int64_t n, const std::vector<double>& values,
                    const std::vector<int>& signals) {
  std::string text;
  text.reserve(signals.size() * 10 + 96);
  text.append("id: ").append(epoch).append(".");
  append_integer(text, k);
  text += "\nevent: frame\ndata: {\"k\":";
  append_integer(text, k);
  text += ",\"t\":";
  append_time(text, t);
  text += ",\"n\":";
  append_integer(text, n);
  text += ",\"v\":[";
  bool first = true;
  for (const int id : signals) {
    if (!first) text += ',';
    first = false;
    const auto at = static_cast<std::size_t>(id);
    append_number(text, at < values.size() ? values[at] : std::nan(""));
  }
  text += "]}\n\n";
  return std::make_shared<const std::string>(as_chunk(text));
}

}  // namespace vigil
