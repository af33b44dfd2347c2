// SPDX-License-Identifier: Apache-2.0
/// The line between a run's supervisor and its component processes: a Unix socket in the abstract
/// namespace, one a DDS domain, so that binding it also holds the domain. Samples between
/// components never travel here; what does is in frames.hpp.
#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "core/archive.hpp"
#include "core/result.hpp"
#include "line/frames.hpp"

namespace clew::bridge {

/// One end of a connected line. Sending is safe from any thread; receiving from one.
class Link {
 public:
  explicit Link(int socket) : socket_(socket) {}
  ~Link();
  Link(const Link&) = delete;
  Link& operator=(const Link&) = delete;

  /// Connects to the supervisor of `domain`, trying until `deadline`.
  static core::Result<int> connect(int domain, std::chrono::steady_clock::time_point deadline);

  int socket() const { return socket_; }

  /// Sends a frame, waiting while the other end is slow. False when the other end is gone.
  bool send_bytes(FrameType type, std::string_view payload);
  template <typename Message>
  bool send(FrameType type, Message message) {
    core::StateWriter writer;
    writer(message);
    return send_bytes(type, writer.bytes());
  }

  /// Sends, without waiting, what goes of a frame's bytes from `offset` on, its head counted in.
  /// Returns where to go on; beyond the last byte, frame_bytes(payload), if all went. None when the
  /// other end is gone. Nothing else may be sent before the frame is whole.
  std::optional<std::size_t> send_some(FrameType type, std::string_view payload,
                                       std::size_t offset);
  static std::size_t frame_bytes(std::string_view payload);

  /// Reads what is there, without waiting. False when the other end is gone.
  bool receive();
  /// The next whole frame received, if any.
  std::optional<Frame> next();

 private:
  int socket_;
  std::mutex sending_;
  std::string received_;
  std::size_t consumed_ = 0;
};

/// The supervisor's listening end, which holds its domain while it lives.
class LinkListener {
 public:
  /// Binds the line of `domain`; none if another run holds it.
  static std::optional<int> bind(int domain);
};

}  // namespace clew::bridge
