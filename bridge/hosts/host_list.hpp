// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/result.hpp"

namespace clew::bridge {

/// Where something listens.
struct TcpAddress {
  std::string address;  ///< IPv4
  std::uint16_t port = 0;

  std::string text() const { return address + ':' + std::to_string(port); }
};

inline constexpr std::uint16_t kHostPort = 7447;

/// Reads `10.0.0.2:7447` or `10.0.0.2`.
core::Result<TcpAddress> read_tcp_address(const std::string& text);

/// The computers that a run may have components on, as a file says (docs/hosts.md):
///
///     identity: keys/desk.run   # from this file's directory
///     here: 10.0.0.1            # this host's address; by default the one that leads to the others
///     hosts:
///       robot: 10.0.0.2:7447
struct HostList {
  std::string identity;
  std::string here;  ///< may be empty
  std::map<std::string, TcpAddress> hosts;

  static core::Result<HostList> read(const std::string& path);
  /// Of that name, or an error that lists the known ones.
  core::Result<TcpAddress> find(const std::string& host) const;
  /// The address of this host, and those of the `used` hosts, each once: where their components
  /// meet.
  core::Result<std::vector<std::string>> addresses(const std::vector<std::string>& used) const;
};

}  // namespace clew::bridge
