/// The head of a request: request line and header fields. A pure function of bytes, so that it can be fuzzed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace vigil {

struct HeadLimits {
  std::size_t bytes = 16 * 1024;
  std::size_t line = 8 * 1024;
  std::size_t fields = 64;
};

struct Head {
  std::string method;
  std::string target;                                       ///< as sent, begins with '/'
  std::string path;                                         ///< up to the '?'
  std::string query;                                        ///< after it, undecoded
  std::vector<std::pair<std::string, std::string>> fields;  ///< values trimmed
  std::string host;                                         ///< "" if there is none
  std::optional<std::uint64_t> content_length;
  bool keep_alive = true;
  bool expects_continue = false;

  /// The first field of that name (any case), or "".
  std::string_view field(std::string_view name) const;
};

/// Why a head is not taken: the status and one sentence. 0: it is.
struct Refusal {
  int status = 0;
  std::string detail;
  explicit operator bool() const { return status != 0; }
};

/// Where the head ends in bytes that are still coming in: nothing is read twice.
class HeadScan {
 public:
  /// The head's length with its blank line, or 0: not there yet. A refusal if it never can be taken (too long, or
  /// plainly not HTTP). `in` is all that came so far; call again with more behind it.
  std::size_t scan(std::string_view in, const HeadLimits& limits, Refusal& refusal);
  void reset() { *this = HeadScan(); }

 private:
  std::size_t seen_ = 0;
  std::size_t line_start_ = 0;
  bool first_line_done_ = false;
};

/// Parses a whole head (blank line included). Refuses what this server never needs and what two readers of one head
/// could take differently: Transfer-Encoding, Content-Encoding, repeated Content-Length or Host, folded lines, control
/// characters, absolute-form targets, REMOTE_* and LOCAL_* fields (the HTTP library behind takes those for its own).
Refusal parse_head(std::string_view bytes, const HeadLimits& limits, Head& head);

}  // namespace vigil
