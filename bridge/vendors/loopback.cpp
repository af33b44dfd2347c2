// SPDX-License-Identifier: Apache-2.0
#include "vendors/loopback.hpp"

#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>

namespace clew::bridge {

std::string loopback_interface() {
  ifaddrs* first = nullptr;
  if (::getifaddrs(&first) != 0) return "";
  std::string name;
  for (const ifaddrs* each = first; each != nullptr && name.empty(); each = each->ifa_next) {
    if (each->ifa_addr == nullptr || each->ifa_addr->sa_family != AF_INET) continue;
    const auto* address = reinterpret_cast<const sockaddr_in*>(each->ifa_addr);
    const bool is_up = (each->ifa_flags & IFF_UP) != 0;
    if (is_up && address->sin_addr.s_addr == htonl(INADDR_LOOPBACK)) name = each->ifa_name;
  }
  ::freeifaddrs(first);
  return name;
}

core::Result<void> check_loopback() {
  if (!loopback_interface().empty()) return {};
  const std::string why =
      "no interface that is up has 127.0.0.1, over which components talk; 'clew doctor' says what "
      "to do, and --layout composed needs none";
  return core::Error{why};
}

}  // namespace clew::bridge
