// SPDX-License-Identifier: Apache-2.0
/// The line between a run's supervisor and its component processes: a Unix socket in the abstract
/// namespace, one a DDS domain, so that binding it also holds the domain. Samples between
/// components never travel here; what does is in frames.hpp.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/archive.hpp"
#include "core/result.hpp"
#include "line/frame_buffer.hpp"
#include "line/frames.hpp"

namespace clew::bridge {

/// One end of a connected line. Nothing here waits but wait_for_frame and flush_until. Sending is
/// safe from any thread, receiving from one. Whatever the other end sends, the worst that happens
/// is that the line is closed.
class Link {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// Takes the socket over. A frame with a payload larger than `most_payload_bytes` closes the
  /// line.
  explicit Link(int socket, std::size_t most_payload_bytes = kMostPayloadBytes)
      : socket_(socket), received_(most_payload_bytes) {}
  ~Link();
  Link(const Link&) = delete;
  Link& operator=(const Link&) = delete;

  /// Connects to the supervisor of `domain`, trying until `deadline`. Refused: one that another
  /// user runs.
  static core::Result<int> connect(int domain, Time deadline);
  /// The same of the run that is called `name`.
  static core::Result<int> connect(const std::string& name, Time deadline);

  int socket() const { return socket_; }
  /// Once the other end has said who it is, it may send more.
  void allow_payload(std::size_t bytes) { received_.allow_payload(bytes); }

  /// Sends a frame: at once what the socket takes, the rest by flush(). False when the other end is
  /// gone.
  bool post_bytes(FrameType type, std::string_view payload);
  template <typename Message>
  bool post(FrameType type, Message message) {
    core::StateWriter writer;
    writer(message);
    return post_bytes(type, writer.bytes());
  }
  /// Sends what waits, as far as the socket takes it. False when the other end is gone.
  bool flush();
  /// Whether something waits: then the socket is to be polled for room, too.
  bool has_unsent() const;
  /// What to poll the socket for.
  short poll_events() const;
  /// Sends what waits, and waits while the other end is slow. False when it has not taken all.
  bool flush_until(Time deadline);

  /// Sends, without waiting, what goes of a frame's bytes from `offset` on, its head counted in.
  /// Returns where to go on; beyond the last byte, frame_bytes(payload), if all went. None when the
  /// other end is gone. Nothing may wait before, and nothing else be sent before the frame is
  /// whole.
  std::optional<std::size_t> send_some(FrameType type, std::string_view payload,
                                       std::size_t offset);
  static std::size_t frame_bytes(std::string_view payload);

  /// Reads what is there, without waiting. False when the other end is gone.
  bool receive();
  /// The next whole frame received, if any.
  std::optional<Frame> next();
  /// The next frame, waited for until `deadline`, while what waits to be sent is sent.
  core::Result<Frame> wait_for_frame(Time deadline);

 private:
  bool flush_locked();

  int socket_;
  mutable std::mutex sending_;
  std::string unsent_;
  std::size_t sent_of_unsent_ = 0;
  FrameBuffer received_;
};

/// The supervisor's listening end, which holds its domain while it lives.
class LinkListener {
 public:
  /// Binds the line of `domain`; none if another run holds it.
  static std::optional<int> bind(int domain);
  /// Binds the line of the run that is called `name`; none if another run is called so.
  static std::optional<int> bind(const std::string& name);
  /// The next connection of a process of our own user or of root, if there is one; others are
  /// closed, and a sentence is added to `refusals` for each.
  static std::optional<int> accept(int socket, std::vector<std::string>& refusals);
};

/// Whether the process at the other end of a connected socket belongs to our own user, or to root:
/// nobody else may take part in a run.
bool is_trusted_peer(int socket);
/// Whether this process started the one at the other end of a connected socket, or started who did.
bool is_descendant(int socket);
/// The same as is_trusted_peer, of a user's number.
bool may_take_part(std::uint32_t peer_user, std::uint32_t own_user);

}  // namespace clew::bridge
