// SPDX-License-Identifier: Apache-2.0
#include "line/link.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <sys/uio.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <thread>

#include "run/limits.hpp"

namespace clew::bridge {
namespace {

constexpr std::size_t kHeaderBytes = 5;  // type, then the payload's length
constexpr std::uint32_t kMaxPayloadBytes = 1u << 30;

using Header = std::array<char, kHeaderBytes>;

Header header_of(FrameType type, std::string_view payload) {
  Header header;
  const auto size = static_cast<std::uint32_t>(payload.size());
  header[0] = static_cast<char>(type);
  std::memcpy(header.data() + 1, &size, sizeof size);
  return header;
}

// An address without a file: it vanishes with its socket, and each network namespace has its own.
struct Address {
  sockaddr_un name{};
  socklen_t size = 0;
};

Address address_of(int domain) {
  Address address;
  address.name.sun_family = AF_UNIX;
  const std::string text = "clew.domain." + std::to_string(domain);
  std::memcpy(address.name.sun_path + 1, text.data(), text.size());
  address.size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + text.size());
  return address;
}

const sockaddr* generic(const Address& address) {
  return reinterpret_cast<const sockaddr*>(&address.name);
}

}  // namespace

Link::~Link() { ::close(socket_); }

core::Result<int> Link::connect(int domain, std::chrono::steady_clock::time_point deadline) {
  const Address address = address_of(domain);
  while (true) {
    const int socket = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (socket < 0) return core::Error{std::strerror(errno), "supervisor's socket", 0, 0};
    if (::connect(socket, generic(address), address.size) == 0) return socket;
    ::close(socket);
    if (std::chrono::steady_clock::now() >= deadline) {
      return core::Error{"no run holds domain " + std::to_string(domain) +
                             "; start one with 'clew run ... --domain " + std::to_string(domain) +
                             " --external STAGE'",
                         {},
                         0,
                         0};
    }
    std::this_thread::sleep_for(kConnectPeriod);
  }
}

std::size_t Link::frame_bytes(std::string_view payload) { return kHeaderBytes + payload.size(); }

std::optional<std::size_t> Link::send_some(FrameType type, std::string_view payload,
                                           std::size_t offset) {
  const Header header = header_of(type, payload);
  const std::lock_guard<std::mutex> lock(sending_);
  while (offset < frame_bytes(payload)) {
    const std::size_t of_payload = offset < kHeaderBytes ? 0 : offset - kHeaderBytes;
    iovec parts[2] = {
        {}, {const_cast<char*>(payload.data()) + of_payload, payload.size() - of_payload}};
    if (offset < kHeaderBytes) {
      parts[0] = {const_cast<char*>(header.data()) + offset, kHeaderBytes - offset};
    }
    msghdr message{};
    message.msg_iov = parts;
    message.msg_iovlen = 2;
    const ssize_t sent = ::sendmsg(socket_, &message, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) return offset;
    if (sent < 0) return std::nullopt;
    offset += static_cast<std::size_t>(sent);
  }
  return offset;
}

bool Link::send_bytes(FrameType type, std::string_view payload) {
  const Header header = header_of(type, payload);
  const std::lock_guard<std::mutex> lock(sending_);
  const auto send_all = [&](const char* data, std::size_t left, int more) {
    while (left > 0) {
      const ssize_t sent = ::send(socket_, data, left, MSG_NOSIGNAL | more);
      if (sent < 0 && errno == EINTR) continue;
      if (sent <= 0) return false;
      data += sent;
      left -= static_cast<std::size_t>(sent);
    }
    return true;
  };
  return send_all(header.data(), header.size(), payload.empty() ? 0 : MSG_MORE) &&
         send_all(payload.data(), payload.size(), 0);
}

bool Link::receive() {
  if (consumed_ > 0) {
    received_.erase(0, consumed_);
    consumed_ = 0;
  }
  char buffer[65536];
  while (true) {
    const ssize_t got = ::recv(socket_, buffer, sizeof buffer, MSG_DONTWAIT);
    if (got > 0) {
      received_.append(buffer, static_cast<std::size_t>(got));
      // One buffer a call, so that one busy line does not hold up the others.
      return true;
    }
    if (got == 0) return false;
    if (errno == EINTR) continue;
    return errno == EAGAIN || errno == EWOULDBLOCK;
  }
}

std::optional<Frame> Link::next() {
  if (received_.size() - consumed_ < kHeaderBytes) return std::nullopt;
  std::uint32_t size = 0;
  std::memcpy(&size, received_.data() + consumed_ + 1, sizeof size);
  CLEW_CHECK(size <= kMaxPayloadBytes, "a frame of " + std::to_string(size) + " bytes");
  if (received_.size() - consumed_ < kHeaderBytes + size) return std::nullopt;
  Frame frame{static_cast<FrameType>(received_[consumed_]),
              received_.substr(consumed_ + kHeaderBytes, size)};
  consumed_ += kHeaderBytes + size;
  return frame;
}

std::optional<int> LinkListener::bind(int domain) {
  const Address address = address_of(domain);
  const int socket = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (socket < 0) return std::nullopt;
  if (::bind(socket, generic(address), address.size) != 0 || ::listen(socket, 64) != 0) {
    ::close(socket);
    return std::nullopt;
  }
  return socket;
}

}  // namespace clew::bridge
