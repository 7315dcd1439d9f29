/// Tokens and the page's sessions. The only secret-handling code of the server.
#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <string_view>

#include "server/front/message.hpp"

namespace vigil {

struct Tokens {
  std::string full;    ///< empty: no token is asked for
  std::string viewer;  ///< read-only; may be empty
  bool required() const { return !full.empty(); }
  /// First line: the token; second line, if any: the viewers' read-only one. Throws std::runtime_error: cannot be read,
  /// shorter than 16 characters, both alike, characters that a header cannot carry, or (warned about by the caller)
  /// nothing else.
  static Tokens from_file(const std::filesystem::path& file);
};

/// Compares without telling by its time how far the two agree.
bool same_secret(std::string_view a, std::string_view b);

/// Sessions of the page: random names handed out for a token, kept in memory, so a restart ends them.
class Doorkeeper {
 public:
  explicit Doorkeeper(Tokens tokens);
  bool required() const { return tokens_.required(); }
  /// From `Authorization: Bearer …` or the cookie `vigil_session`; full where no token is set.
  Access access(std::string_view authorization, std::string_view cookie) const;
  /// A new session for a bearer of a token; the value of Set-Cookie. `access` must not be none.
  std::string open_session(Access access);
  /// Ends the session named in the Cookie header; returns the Set-Cookie that clears it.
  std::string close_session(std::string_view cookie);

 private:
  Tokens tokens_;
  mutable std::mutex mutex_;
  std::map<std::string, Access, std::less<>> sessions_;
  std::vector<std::string> order_;  ///< oldest first: the table is bounded
};

}  // namespace vigil
