// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <openssl/ssl.h>

#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/archive.hpp"
#include "core/result.hpp"
#include "hosts/host_identity.hpp"
#include "line/frame_buffer.hpp"
#include "line/frames.hpp"

namespace clew::bridge {

class Link;

using TlsContextPtr = std::unique_ptr<SSL_CTX, OpensslDeleter<SSL_CTX_free>>;

/// What connections of a computer in that role share: TLS 1.3 and nothing older, its own identity,
/// and its authority as the only one that it believes.
core::Result<TlsContextPtr> make_tls_context(const HostIdentity& identity, HostRole role);

/// One end of a connection that carries the frames of a line (line/frames.hpp). Both ends prove who
/// they are; until they have, nothing that is received means anything. Nothing here waits. Whatever
/// the other end sends, the worst that happens is that the connection closes and says why.
class TlsLine {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// Takes the socket over. `own` is the role of this end, and `expected` the name that the other
  /// one must have; empty: any.
  TlsLine(int socket, SSL_CTX& context, HostRole own, std::string expected, Time now);
  ~TlsLine();
  TlsLine(const TlsLine&) = delete;
  TlsLine& operator=(const TlsLine&) = delete;

  int socket() const { return socket_; }
  /// What to poll the socket for; `reads` as in turn, which is to be the next call.
  short poll_events(bool reads = true) const;
  /// Goes on as far as the socket allows: the handshake, what waits to be sent, and, if `reads`,
  /// what has come.
  void turn(Time now, bool reads = true);

  /// Whether the other end has proved who it is.
  bool is_open() const { return state_ == State::kOpen; }
  bool is_closed() const { return state_ == State::kClosed; }
  /// Why it is closed.
  const std::string& why() const { return why_; }
  /// Whether it was closed because one end does not believe the other: trying again is no use.
  bool was_refused() const { return refused_; }
  /// Whether it was closed because the other end said goodbye.
  bool was_left() const { return left_; }
  /// The name of the other end, once it is open.
  const std::string& peer() const { return peer_; }
  /// When something came last.
  Time heard_at() const { return heard_at_; }

  /// Once the other end has said what it wants, it may send more.
  void allow_payload(std::size_t bytes) { received_.allow_payload(bytes); }
  /// The next whole frame received, if any.
  std::optional<Frame> next();

  /// Sends a frame: at once what the socket takes, the rest in later turns.
  void post_bytes(FrameType type, std::string_view payload);
  template <typename Message>
  void post(FrameType type, Message message) {
    core::StateWriter writer;
    writer(message);
    post_bytes(type, writer.bytes());
  }
  /// What waits to be sent.
  std::size_t unsent_bytes() const { return unsent_.size() - sent_of_unsent_; }
  /// Says goodbye, if all was sent, and closes.
  void close(std::string why);

 private:
  enum class State { kHandshake, kOpen, kClosed };

  void shake_hands();
  void send();
  void receive(Time now);
  /// What became of a call: true if it only has to wait for the socket.
  bool waits(int result);
  void fail(int result, const char* doing);
  core::Result<std::string> check_peer();

  using SslPtr = std::unique_ptr<SSL, OpensslDeleter<SSL_free>>;

  int socket_;
  HostRole own_;
  std::string expected_;
  SslPtr ssl_;
  State state_ = State::kHandshake;
  bool wants_write_ = false;
  bool refused_ = false;
  bool left_ = false;
  std::string why_;
  std::string peer_;
  Time heard_at_;
  std::string unsent_;
  std::size_t sent_of_unsent_ = 0;
  FrameBuffer received_;
};

/// What to poll a component's or supervisor's link for, whose frames go on to `line`: nothing is
/// read of it while too much waits there.
short events_passed_to(const TlsLine& line, const Link& link);

}  // namespace clew::bridge
