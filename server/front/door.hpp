/// Who may come in, with what: every check that needs no more than the head. No socket in it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "server/front/head.hpp"
#include "server/front/reply.hpp"
#include "server/front/route.hpp"
#include "server/front/static_files.hpp"
#include "server/front/token.hpp"

namespace vigil {

/// What the door decided.
struct Pass {
  Refusal refusal;       ///< set: answer that, with `headers`
  HeaderList headers;    ///< Allow, WWW-Authenticate
  bool options = false;  ///< answer 204 with `headers`
  Routes::Match match;   ///< no route in it: a file of the page
  Access access = Access::none;
  std::size_t body_limit = 0;  ///< bytes
};

class Door {
 public:
  Door(std::string host, std::vector<std::string> allow_hosts, std::size_t body_limit, const Routes& routes,
       const StaticFiles& files, const Doorkeeper& keeper);

  /// local: the address the client connected to, as text without the port ("" where unknown).
  Pass check(const Head& head, std::string_view local) const;

 private:
  bool host_allowed(std::string_view host, std::string_view local) const;
  void refuse(Pass& pass, int status, std::string detail) const { pass.refusal = {status, std::move(detail)}; }
  void check_identity(const Head& head, Pass& pass) const;
  void check_method(const Head& head, Pass& pass) const;
  void check_origin(const Head& head, Pass& pass) const;
  void check_body(const Head& head, Pass& pass) const;

  std::vector<std::string> hosts_;
  std::size_t body_limit_;
  const Routes& routes_;
  const StaticFiles& files_;
  const Doorkeeper& keeper_;
};

/// "name" of "name:port" and "[v6]:port", in lower case, brackets removed; "" if it is neither.
std::string host_name(std::string_view host);

}  // namespace vigil
