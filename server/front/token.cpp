#include "server/front/token.hpp"

#include <sys/random.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <stdexcept>

namespace vigil {
namespace {

constexpr std::size_t kShortestToken = 16;
constexpr std::size_t kSessions = 1000;
constexpr std::string_view kCookie = "vigil_session=";

std::string random_name() {
  std::array<unsigned char, 32> bytes;
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    throw std::runtime_error("the system gives no random bytes");
  }
  static constexpr char kHex[] = "0123456789abcdef";
  std::string name;
  for (const unsigned char byte : bytes) {
    name += kHex[byte >> 4];
    name += kHex[byte & 15];
  }
  return name;
}

void check_token(const std::string& token, std::string_view which, const std::filesystem::path& file) {
  const std::string where = "the " + std::string(which) + " in " + file.string();
  if (token.size() < kShortestToken) throw std::runtime_error(where + " is shorter than 16 characters");
  const bool clean = std::all_of(token.begin(), token.end(), [](char c) { return c > 0x20 && c < 0x7f; });
  if (!clean) throw std::runtime_error(where + " holds a character other than printable ASCII without spaces");
}

std::string cookie_line(std::string_view value, std::string_view more) {
  std::string line(kCookie);
  return line.append(value).append("; Path=/; HttpOnly; SameSite=Strict").append(more);
}

std::string session_of(std::string_view cookie) {
  while (!cookie.empty()) {
    const auto end = cookie.find(';');
    std::string_view one = cookie.substr(0, end);
    cookie = end == std::string_view::npos ? std::string_view() : cookie.substr(end + 1);
    while (!one.empty() && one.front() == ' ') one.remove_prefix(1);
    if (one.starts_with(kCookie)) return std::string(one.substr(kCookie.size()));
  }
  return {};
}

}  // namespace

Tokens Tokens::from_file(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error("cannot read the token file " + file.string());
  Tokens tokens;
  std::getline(in, tokens.full);
  std::getline(in, tokens.viewer);
  for (std::string* token : {&tokens.full, &tokens.viewer}) {
    if (!token->empty() && token->back() == '\r') token->pop_back();
  }
  check_token(tokens.full, "token (first line)", file);
  if (!tokens.viewer.empty()) check_token(tokens.viewer, "viewers' token (second line)", file);
  if (tokens.full == tokens.viewer) throw std::runtime_error("both tokens in " + file.string() + " are the same");
  return tokens;
}

bool same_secret(std::string_view a, std::string_view b) {
  // The loop's length depends on the secret alone, never on what was guessed right.
  unsigned difference = a.size() == b.size() ? 0 : 1;
  for (std::size_t i = 0; i < b.size(); ++i) {
    difference |= static_cast<unsigned char>(b[i]) ^ static_cast<unsigned char>(i < a.size() ? a[i] : 0);
  }
  return difference == 0;
}

Doorkeeper::Doorkeeper(Tokens tokens) : tokens_(std::move(tokens)) {}

Access Doorkeeper::access(std::string_view authorization, std::string_view cookie) const {
  if (!tokens_.required()) return Access::full;
  if (authorization.starts_with("Bearer ")) {
    const std::string_view token = authorization.substr(7);
    const bool full = same_secret(token, tokens_.full);
    const bool viewer = !tokens_.viewer.empty() && same_secret(token, tokens_.viewer);
    if (full) return Access::full;
    if (viewer) return Access::viewer;
    return Access::none;
  }
  const std::string session = session_of(cookie);
  if (session.empty()) return Access::none;
  const std::lock_guard lock(mutex_);
  // 256 random bits: finding one by the time of a lookup is out of reach.
  const auto found = sessions_.find(session);
  return found == sessions_.end() ? Access::none : found->second;
}

std::string Doorkeeper::open_session(Access access) {
  const std::string name = random_name();
  const std::lock_guard lock(mutex_);
  sessions_[name] = access;
  order_.push_back(name);
  if (order_.size() > kSessions) {
    sessions_.erase(order_.front());
    order_.erase(order_.begin());
  }
  return cookie_line(name, "");
}

std::string Doorkeeper::close_session(std::string_view cookie) {
  const std::string name = session_of(cookie);
  const std::lock_guard lock(mutex_);
  sessions_.erase(name);
  std::erase(order_, name);
  return cookie_line("", "; Max-Age=0");
}

}  // namespace vigil
