// SPDX-License-Identifier: Apache-2.0
#include "test_domain.hpp"

#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include "core/check.hpp"
#include "dds/loopback.hpp"

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
  // Not from 0 for everybody: tests that run at once should rarely ask for the same port.
  const int first = static_cast<int>(getpid() % (kMaxDomain + 1));
  for (int i = 0; i <= kMaxDomain && socket_ < 0; ++i) {
    number_ = (first + i) % (kMaxDomain + 1);
    const int participant = bind_port(discovery_port(number_, 0));
    if (participant < 0) continue;
    close(participant);
    socket_ = bind_port(discovery_port(number_, 0) - 10);
  }
  CLEW_CHECK(socket_ >= 0, "all DDS domains are in use");
}

TestDomain::~TestDomain() { close(socket_); }

}  // namespace clew::bridge
