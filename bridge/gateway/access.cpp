// SPDX-License-Identifier: Apache-2.0
#include "gateway/access.hpp"

#include <fmt/format.h>
#include <sys/random.h>

#include <array>

#include "core/check.hpp"

namespace clew::bridge {
namespace {

/// In a time that does not tell how much of it is right.
bool same_secret(std::string_view given, std::string_view secret) {
  if (given.size() != secret.size()) return false;
  unsigned different = 0;
  for (std::size_t i = 0; i < given.size(); ++i) {
    different |= static_cast<unsigned>(static_cast<unsigned char>(given[i]) ^
                                       static_cast<unsigned char>(secret[i]));
  }
  return different == 0;
}

std::string_view without_blanks(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// The value of `name` in a list of `name=value` with this separator.
std::string_view value_of(std::string_view list, std::string_view name, char separator) {
  while (!list.empty()) {
    const std::size_t end = std::min(list.find(separator), list.size());
    const std::string_view entry = without_blanks(list.substr(0, end));
    const std::size_t equals = entry.find('=');
    if (equals != std::string_view::npos && entry.substr(0, equals) == name) {
      return entry.substr(equals + 1);
    }
    list.remove_prefix(std::min(end + 1, list.size()));
  }
  return {};
}

}  // namespace

std::string_view query_value(std::string_view query, std::string_view name) {
  return value_of(query, name, '&');
}

Access Access::with_random_token() {
  std::array<unsigned char, 16> bytes{};
  CLEW_CHECK(::getrandom(bytes.data(), bytes.size(), 0) == static_cast<ssize_t>(bytes.size()),
             "no random bytes");
  std::string token;
  for (const unsigned char byte : bytes) token += fmt::format("{:02x}", byte);
  return Access(std::move(token));
}

std::string Access::address() const {
  return fmt::format("http://127.0.0.1:{}/?token={}", port_, token_);
}

std::string Access::cookie_header() const {
  return fmt::format("{}={}; HttpOnly; SameSite=Strict; Path=/", cookie_name(), token_);
}

bool Access::is_own_host(const Credentials& request) const {
  return request.host == fmt::format("127.0.0.1:{}", port_) ||
         request.host == fmt::format("localhost:{}", port_);
}

bool Access::has_token(const Credentials& request) const {
  return same_secret(query_value(request.query, "token"), token_);
}

bool Access::has_cookie(const Credentials& request) const {
  return same_secret(value_of(request.cookies, cookie_name(), ';'), token_);
}

bool Access::is_own_origin(const Credentials& request) const {
  return is_own_host(request) && request.origin == fmt::format("http://{}", request.host);
}

bool Access::may_read(const Credentials& request) const {
  const bool foreign_page = !request.origin.empty() && !is_own_origin(request);
  return is_own_host(request) && !foreign_page && (has_token(request) || has_cookie(request));
}

bool Access::may_control(const Credentials& request) const {
  return is_own_origin(request) && has_cookie(request);
}

}  // namespace clew::bridge
