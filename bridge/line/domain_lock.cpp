// SPDX-License-Identifier: Apache-2.0
#include "line/domain_lock.hpp"

#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <utility>

#include "dds/rtps_ports.hpp"
#include "line/link.hpp"
#include "run/limits.hpp"

namespace clew::bridge {
namespace {

// Domain 0 is everybody's default.
constexpr int kFirstDomain = 1;

// Domains on whose ports any program of this host has a UDP socket.
std::set<int> domains_in_use() {
  std::set<int> domains;
  for (const char* table : {"/proc/net/udp", "/proc/net/udp6"}) {
    std::ifstream stream(table);
    std::string line;
    std::getline(stream, line);  // headings
    while (std::getline(stream, line)) {
      std::istringstream words(line);
      std::string slot, local;
      words >> slot >> local;
      const std::size_t colon = local.rfind(':');
      if (colon == std::string::npos) continue;
      const int port = std::stoi(local.substr(colon + 1), nullptr, 16);
      if (port >= kPortBase) domains.insert((port - kPortBase) / kPortsPerDomain);
    }
  }
  return domains;
}

}  // namespace

core::Result<DomainLock> DomainLock::take(std::optional<int> domain) {
  if (domain) {
    CLEW_RETURN_IF_ERROR(check_domain(*domain));
    if (const auto socket = LinkListener::bind(*domain)) return DomainLock(*domain, *socket);
    return core::Error{"domain " + std::to_string(*domain) + " is held by another run"};
  }
  const std::set<int> used = domains_in_use();
  for (int candidate = kFirstDomain; candidate <= kMaxDomain; ++candidate) {
    if (used.count(candidate) != 0) continue;
    if (const auto socket = LinkListener::bind(candidate)) return DomainLock(candidate, *socket);
  }
  return core::Error{"no DDS domain from 1 to " + std::to_string(kMaxDomain) +
                     " is free on this host"};
}

DomainLock::DomainLock(DomainLock&& other) noexcept
    : domain_(other.domain_), socket_(std::exchange(other.socket_, -1)) {}

DomainLock::~DomainLock() {
  if (socket_ >= 0) ::close(socket_);
}

core::Result<RunName> RunName::take(const std::string& name) {
  const bool plain = std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '-' || c == '_' || c == '.';
  });
  const bool number =
      std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
  if (name.empty() || name.size() > kMostNameBytes || !plain || number) {
    return core::Error{"found '" + name + "'; allowed: letters, digits, '-', '_' and '.', up to " +
                           std::to_string(kMostNameBytes) + " of them, and not digits alone",
                       "--name"};
  }
  if (const auto socket = LinkListener::bind(name)) return RunName(*socket);
  return core::Error{"another run is called '" + name + "'", "--name"};
}

RunName::RunName(RunName&& other) noexcept : socket_(std::exchange(other.socket_, -1)) {}

RunName::~RunName() {
  if (socket_ >= 0) ::close(socket_);
}

}  // namespace clew::bridge
