// SPDX-License-Identifier: Apache-2.0
#include "cyclonedds/loopback_sockets.hpp"

#include <netinet/in.h>
#include <sys/socket.h>

#include <cstdlib>
#include <filesystem>
#include <system_error>

#include "dds/rtps_ports.hpp"

namespace clew::bridge {
namespace {

bool receives_on_all_addresses(int fd, std::uint32_t first_port, std::uint32_t last_port) {
  sockaddr_storage storage{};
  socklen_t size = sizeof storage;
  auto* address = reinterpret_cast<sockaddr*>(&storage);
  if (getsockname(fd, address, &size) != 0 || storage.ss_family != AF_INET) return false;
  const auto* ip = reinterpret_cast<const sockaddr_in*>(&storage);
  const std::uint32_t port = ntohs(ip->sin_port);
  return ip->sin_addr.s_addr == INADDR_ANY && port >= first_port && port <= last_port;
}

}  // namespace

void confine_to_loopback(int domain) {
  constexpr char kInterface[] = "lo";
  const std::uint32_t first_port = discovery_port(domain, 0);
  const std::uint32_t last_port = discovery_port(domain, kMaxParticipantIndex) + 1;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd", error)) {
    const int fd = std::atoi(entry.path().filename().c_str());
    if (!receives_on_all_addresses(fd, first_port, last_port)) continue;
    setsockopt(fd, SOL_SOCKET, SO_BINDTODEVICE, kInterface, sizeof kInterface);
  }
}

}  // namespace clew::bridge
