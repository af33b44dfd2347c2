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
#include <fstream>
#include <sstream>
#include <thread>
#include <utility>

#include "run/limits.hpp"

namespace clew::bridge {
namespace {

constexpr std::size_t kHeaderBytes = FrameBuffer::kHeaderBytes;

// An address without a file: it vanishes with its socket, and each network namespace has its own.
struct Address {
  sockaddr_un name{};
  socklen_t size = 0;
};

std::string line_of(int domain) { return "clew.domain." + std::to_string(domain); }
std::string line_of(const std::string& name) { return "clew.run." + name; }

Address address_of(const std::string& text) {
  Address address;
  address.name.sun_family = AF_UNIX;
  CLEW_CHECK(text.size() + 1 < sizeof address.name.sun_path, text);
  std::memcpy(address.name.sun_path + 1, text.data(), text.size());
  address.size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + text.size());
  return address;
}

const sockaddr* generic(const Address& address) {
  return reinterpret_cast<const sockaddr*>(&address.name);
}

/// False if nothing has happened by the deadline.
bool poll_until(pollfd& descriptor, Link::Time deadline) {
  const auto left =
      std::chrono::ceil<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
  return left.count() > 0 && ::poll(&descriptor, 1, static_cast<int>(left.count())) != 0;
}

std::optional<int> listen_at(const std::string& line) {
  const Address address = address_of(line);
  const int socket = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (socket < 0) return std::nullopt;
  if (::bind(socket, generic(address), address.size) != 0 || ::listen(socket, 64) != 0) {
    ::close(socket);
    return std::nullopt;
  }
  return socket;
}

std::optional<ucred> peer_of(int socket) {
  ucred peer{};
  socklen_t size = sizeof peer;
  if (::getsockopt(socket, SOL_SOCKET, SO_PEERCRED, &peer, &size) != 0) return std::nullopt;
  return peer;
}

/// Who started a process; 0 if it has ended.
pid_t parent_of(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string stat;
  std::getline(file, stat);
  // "PID (NAME) STATE PARENT ...": a name may hold anything but its end.
  const std::size_t name_end = stat.rfind(')');
  if (name_end == std::string::npos) return 0;
  std::istringstream fields(stat.substr(name_end + 1));
  char state = 0;
  pid_t parent = 0;
  fields >> state >> parent;
  return parent;
}

core::Error refused(std::string why) { return {std::move(why)}; }

/// Connects, trying until `deadline`; `what` is held by the run: `domain 3`.
core::Result<int> connect_to(const Address& address, const std::string& what, Link::Time deadline,
                             const std::string& nobody) {
  while (true) {
    const int socket = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (socket < 0) return core::Error{std::strerror(errno), "supervisor's socket"};
    if (::connect(socket, generic(address), address.size) == 0) {
      if (is_trusted_peer(socket)) return socket;
      ::close(socket);
      return refused(what + " is held by a run of another user");
    }
    ::close(socket);
    if (std::chrono::steady_clock::now() >= deadline) return refused(nobody);
    std::this_thread::sleep_for(kConnectPeriod);
  }
}

}  // namespace

Link::~Link() { ::close(socket_); }

core::Result<int> Link::connect(int domain, Time deadline) {
  const std::string number = std::to_string(domain);
  return connect_to(
      address_of(line_of(domain)), "domain " + number, deadline,
      "no run holds domain " + number + "; 'clew run ... --domain " + number +
          "' starts one, and with --external STAGE waits for a component that you start");
}

core::Result<int> Link::connect(const std::string& name, Time deadline) {
  return connect_to(address_of(line_of(name)), "the name '" + name + "'", deadline,
                    "no run is called '" + name + "'");
}

std::size_t Link::frame_bytes(std::string_view payload) { return kHeaderBytes + payload.size(); }

std::optional<std::size_t> Link::send_some(FrameType type, std::string_view payload,
                                           std::size_t offset) {
  const auto header = FrameBuffer::header_of(type, payload);
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

bool Link::post_bytes(FrameType type, std::string_view payload) {
  const auto header = FrameBuffer::header_of(type, payload);
  const std::lock_guard<std::mutex> lock(sending_);
  unsent_.append(header.data(), header.size()).append(payload);
  return flush_locked();
}

bool Link::flush() {
  const std::lock_guard<std::mutex> lock(sending_);
  return flush_locked();
}

bool Link::flush_locked() {
  while (sent_of_unsent_ < unsent_.size()) {
    const ssize_t sent = ::send(socket_, unsent_.data() + sent_of_unsent_,
                                unsent_.size() - sent_of_unsent_, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0) return errno == EAGAIN || errno == EWOULDBLOCK;
    sent_of_unsent_ += static_cast<std::size_t>(sent);
  }
  unsent_.clear();
  sent_of_unsent_ = 0;
  return true;
}

bool Link::has_unsent() const {
  const std::lock_guard<std::mutex> lock(sending_);
  return !unsent_.empty();
}

short Link::poll_events() const { return has_unsent() ? POLLIN | POLLOUT : POLLIN; }

bool Link::flush_until(Time deadline) {
  while (flush()) {
    if (!has_unsent()) return true;
    pollfd descriptor{socket_, POLLOUT, 0};
    if (!poll_until(descriptor, deadline)) return false;
  }
  return false;
}

bool Link::receive() {
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
  auto frame = received_.next();
  // The next receive() finds the line closed.
  if (received_.too_large()) ::shutdown(socket_, SHUT_RDWR);
  return frame;
}

core::Result<Frame> Link::wait_for_frame(Time deadline) {
  while (true) {
    if (auto frame = next()) return *std::move(frame);
    pollfd descriptor{socket_, poll_events(), 0};
    if (!poll_until(descriptor, deadline)) {
      return core::Error{"the supervisor does not answer"};
    }
    if (!flush() || !receive()) return core::Error{"the supervisor has gone"};
  }
}

std::optional<int> LinkListener::bind(int domain) { return listen_at(line_of(domain)); }
std::optional<int> LinkListener::bind(const std::string& name) { return listen_at(line_of(name)); }

std::optional<int> LinkListener::accept(int socket, std::vector<std::string>& refusals) {
  // Who is turned away may come again at once: not for ever.
  for (std::size_t i = 0; i < kMostNewcomers; ++i) {
    const int connection = ::accept4(socket, nullptr, nullptr, SOCK_CLOEXEC);
    if (connection < 0) return std::nullopt;
    if (is_trusted_peer(connection)) return connection;
    const auto peer = peer_of(connection);
    refusals.push_back("a process of user " + (peer ? std::to_string(peer->uid) : "unknown") +
                       " has connected, and is turned away");
    ::close(connection);
  }
  return std::nullopt;
}

bool may_take_part(std::uint32_t peer_user, std::uint32_t own_user) {
  return peer_user == own_user || peer_user == 0;
}

bool is_trusted_peer(int socket) {
  const auto peer = peer_of(socket);
  return peer && may_take_part(peer->uid, ::geteuid());
}

bool is_descendant(int socket) {
  const auto peer = peer_of(socket);
  pid_t process = peer ? parent_of(peer->pid) : 0;
  // Process 1 started all.
  while (process > 1 && process != ::getpid()) process = parent_of(process);
  return process == ::getpid();
}

}  // namespace clew::bridge
