// SPDX-License-Identifier: Apache-2.0
#include "hosts/tcp_socket.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

namespace clew::bridge {
namespace {

using core::Error;
using core::Result;

constexpr int kBacklog = 64;

sockaddr_in to_system(const TcpAddress& address) {
  sockaddr_in system{};
  system.sin_family = AF_INET;
  system.sin_port = htons(address.port);
  ::inet_pton(AF_INET, address.address.c_str(), &system.sin_addr);
  return system;
}

TcpAddress from_system(const sockaddr_in& system) {
  std::array<char, INET_ADDRSTRLEN> text{};
  ::inet_ntop(AF_INET, &system.sin_addr, text.data(), text.size());
  return {text.data(), ntohs(system.sin_port)};
}

template <typename Ask>
TcpAddress end_of(int socket, Ask ask) {
  sockaddr_in system{};
  socklen_t size = sizeof system;
  if (ask(socket, reinterpret_cast<sockaddr*>(&system), &size) != 0) return {};
  return from_system(system);
}

const sockaddr* generic(const sockaddr_in& system) {
  return reinterpret_cast<const sockaddr*>(&system);
}

/// Lines of a run are small and in a hurry. What is lost again and again is sent again after the
/// same time, not after twice as long: at one packet of five that would be silence for seconds.
void prepare(int socket) {
  const int yes = 1;
  ::setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
  ::setsockopt(socket, IPPROTO_TCP, TCP_THIN_LINEAR_TIMEOUTS, &yes, sizeof yes);
}

Error failed(int socket, const TcpAddress& where) {
  Error error{std::strerror(errno), where.text()};
  if (socket >= 0) ::close(socket);
  return error;
}

}  // namespace

Result<int> listen_on(const TcpAddress& where) {
  const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (socket < 0) return failed(socket, where);
  const int yes = 1;
  ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  const sockaddr_in system = to_system(where);
  if (::bind(socket, generic(system), sizeof system) != 0 || ::listen(socket, kBacklog) != 0) {
    return failed(socket, where);
  }
  return socket;
}

TcpAddress own_end(int socket) { return end_of(socket, ::getsockname); }
TcpAddress other_end(int socket) { return end_of(socket, ::getpeername); }

int accept_next(int listening) {
  const int socket = ::accept4(listening, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
  if (socket >= 0) prepare(socket);
  return socket;
}

Result<int> begin_connecting(const TcpAddress& where) {
  const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (socket < 0) return failed(socket, where);
  prepare(socket);
  const sockaddr_in system = to_system(where);
  if (::connect(socket, generic(system), sizeof system) != 0 && errno != EINPROGRESS) {
    return failed(socket, where);
  }
  return socket;
}

// A datagram socket that is connected sends nothing, but knows the way.
Result<std::string> address_towards(const TcpAddress& where) {
  const int socket = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (socket < 0) return failed(socket, where);
  const sockaddr_in system = to_system(where);
  if (::connect(socket, generic(system), sizeof system) != 0) return failed(socket, where);
  const std::string own = own_end(socket).address;
  ::close(socket);
  return own;
}

}  // namespace clew::bridge
