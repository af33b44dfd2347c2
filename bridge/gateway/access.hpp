// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace clew::bridge {

/// What a request says of where it comes from and what it knows. All of it is a stranger's.
struct Credentials {
  std::string_view host;
  std::string_view origin;  ///< empty: none was sent
  std::string_view query;   ///< behind the question mark
  std::string_view cookies;
};

/// Who may see a gateway's pages. A web page of somebody else's can make this machine's browser
/// send requests here, and can make a name of its own point here: so the host must be ours, and
/// the token or the cookie that it was exchanged for must be there.
class Access {
 public:
  /// With a token of 128 random bits.
  static Access with_random_token();
  explicit Access(std::string token) : token_(std::move(token)) {}

  const std::string& token() const { return token_; }
  void set_port(int port) { port_ = port; }
  int port() const { return port_; }
  /// Where a person begins.
  std::string address() const;
  /// The header that gives a page its cookie: for this host, for no script, for no other site.
  std::string cookie_header() const;

  /// A name that somebody made point here is not ours.
  bool is_own_host(const Credentials& request) const;
  bool has_token(const Credentials& request) const;
  bool has_cookie(const Credentials& request) const;
  /// Whether a page of ours sent it.
  bool is_own_origin(const Credentials& request) const;
  /// Pages and recordings: for the token or the cookie, and for no foreign page.
  bool may_read(const Credentials& request) const;
  /// Whatever starts something: for the cookie, from our own page.
  bool may_control(const Credentials& request) const;

 private:
  std::string cookie_name() const { return "clew_view_" + std::to_string(port_); }

  std::string token_;
  int port_ = 0;
};

/// The value of `name` in `a=1&b=2`; empty if it is not there.
std::string_view query_value(std::string_view query, std::string_view name);

}  // namespace clew::bridge
