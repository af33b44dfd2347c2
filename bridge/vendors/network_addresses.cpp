// SPDX-License-Identifier: Apache-2.0
#include "vendors/network_addresses.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>

#include <algorithm>

namespace clew::bridge {
namespace {

bool is_ipv4(const std::string& text) {
  in_addr address{};
  return text.find('\0') == std::string::npos && ::inet_pton(AF_INET, text.c_str(), &address) == 1;
}

}  // namespace

bool is_own_address(const std::string& address) {
  in_addr wanted{};
  ifaddrs* first = nullptr;
  if (::inet_pton(AF_INET, address.c_str(), &wanted) != 1 || ::getifaddrs(&first) != 0) {
    return false;
  }
  bool found = false;
  for (const ifaddrs* each = first; each != nullptr && !found; each = each->ifa_next) {
    if (each->ifa_addr == nullptr || each->ifa_addr->sa_family != AF_INET) continue;
    const auto* own = reinterpret_cast<const sockaddr_in*>(each->ifa_addr);
    found = (each->ifa_flags & IFF_UP) != 0 && own->sin_addr.s_addr == wanted.s_addr;
  }
  ::freeifaddrs(first);
  return found;
}

core::Result<std::optional<NetworkAddresses>> network_of(
    const std::vector<std::string>& addresses) {
  // They become part of the vendors' settings, and may come from another computer.
  for (const std::string& address : addresses) {
    if (is_ipv4(address)) continue;
    return core::Error{"found '" + address + "'; allowed: an IPv4 address of a host of the run"};
  }
  if (addresses.empty()) return std::optional<NetworkAddresses>();
  const auto own = std::find_if(addresses.begin(), addresses.end(), is_own_address);
  if (own != addresses.end()) return std::optional<NetworkAddresses>({*own, addresses});
  return core::Error{fmt::format(
      "no interface of this host that is up has one of the addresses of the run's hosts, {}",
      fmt::join(addresses, ", "))};
}

}  // namespace clew::bridge
