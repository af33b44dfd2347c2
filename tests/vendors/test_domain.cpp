// SPDX-License-Identifier: Apache-2.0
#include "test_domain.hpp"

#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include "core/check.hpp"
#include "dds/rtps_ports.hpp"

namespace clew::bridge {
namespace {

/// A UDP socket on this port of all interfaces, or -1 if somebody has it.
int bind_port(std::uint32_t port) {
  const int fd = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  if (bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) return fd;
  close(fd);
  return -1;
}

}  // namespace

TestDomain::TestDomain() {
  // The upper half: runs take their domains from below. Not the same first one for everybody, since
  // tests run at once.
  constexpr int kFirst = (kMaxDomain + 1) / 2;
  constexpr int kCount = kMaxDomain + 1 - kFirst;
  for (int i = 0; i < kCount && socket_ < 0; ++i) {
    number_ = kFirst + (getpid() + i) % kCount;
    const int participant = bind_port(discovery_port(number_, 0));
    if (participant < 0) continue;
    close(participant);
    socket_ = bind_port(discovery_port(number_, 0) - 10);
  }
  CLEW_CHECK(socket_ >= 0, "all DDS domains from 50 to 99 are in use");
}

TestDomain::~TestDomain() { close(socket_); }

}  // namespace clew::bridge
