// SPDX-License-Identifier: Apache-2.0
#include "hosts/tls_line.hpp"

#include <openssl/err.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <ctime>
#include <utility>

#include "hosts/host_frames.hpp"
#include "line/link.hpp"
#include "run/limits.hpp"

namespace clew::bridge {
namespace {

using core::Error;
using core::Result;

constexpr std::size_t kMostAtOnce = std::size_t{256} * 1024;
/// What the other end may send before what came is looked at.
constexpr std::size_t kMostReceivedAtOnce = std::size_t{1} << 20;

/// All that OpenSSL has noted of the last call; the last of it says most.
std::string all_reasons() {
  std::string text;
  while (const unsigned long code = ERR_get_error()) {
    const char* const reason = ERR_reason_error_string(code);
    if (reason != nullptr) text += (text.empty() ? "" : "; ") + std::string(reason);
  }
  return text.empty() ? "unknown reason" : text;
}

}  // namespace

Result<TlsContextPtr> make_tls_context(const HostIdentity& identity, HostRole role) {
  ERR_clear_error();
  TlsContextPtr context(
      SSL_CTX_new(role == HostRole::kHost ? TLS_server_method() : TLS_client_method()));
  if (context == nullptr) return Error{all_reasons(), {}};
  const CertificatePtr authority = parse_certificate(identity.authority);
  const CertificatePtr own = parse_certificate(identity.own.certificate);
  const KeyPtr key = parse_private_key(identity.own.private_key);
  const bool good =
      authority != nullptr && own != nullptr && key != nullptr &&
      SSL_CTX_set_min_proto_version(context.get(), TLS1_3_VERSION) == 1 &&
      X509_STORE_add_cert(SSL_CTX_get_cert_store(context.get()), authority.get()) == 1 &&
      SSL_CTX_use_certificate(context.get(), own.get()) == 1 &&
      SSL_CTX_use_PrivateKey(context.get(), key.get()) == 1;
  if (!good) return Error{all_reasons(), {}};
  SSL_CTX_set_verify(context.get(), SSL_VERIFY_PEER | SSL_VERIFY_FAIL_IF_NO_PEER_CERT, nullptr);
  // Every connection proves anew who is there: none is resumed.
  SSL_CTX_set_session_cache_mode(context.get(), SSL_SESS_CACHE_OFF);
  SSL_CTX_set_options(context.get(), SSL_OP_NO_TICKET);
  SSL_CTX_set_num_tickets(context.get(), 0);
  SSL_CTX_set_mode(context.get(),
                   SSL_MODE_ENABLE_PARTIAL_WRITE | SSL_MODE_ACCEPT_MOVING_WRITE_BUFFER);
  return context;
}

TlsLine::TlsLine(int socket, SSL_CTX& context, HostRole own, std::string expected, Time now)
    : socket_(socket),
      own_(own),
      expected_(std::move(expected)),
      ssl_(SSL_new(&context)),
      heard_at_(now),
      received_(kMostHelloBytes) {
  if (ssl_ == nullptr || SSL_set_fd(ssl_.get(), socket) != 1) {
    close(all_reasons());
    return;
  }
  if (own == HostRole::kHost) {
    SSL_set_accept_state(ssl_.get());
  } else {
    SSL_set_connect_state(ssl_.get());
    wants_write_ = true;  // so that the end of connect(2) is noticed
  }
}

TlsLine::~TlsLine() { ::close(socket_); }

short TlsLine::poll_events(bool reads) const {
  if (is_closed()) return 0;
  const bool writes = wants_write_ || (is_open() && unsent_bytes() > 0);
  const int in = reads || !is_open() ? POLLIN : 0;
  return static_cast<short>(writes ? in | POLLOUT : in);
}

void TlsLine::turn(Time now, bool reads) {
  if (state_ == State::kHandshake) {
    pollfd descriptor{socket_, POLLOUT, 0};
    // Not connected yet: a handshake would fail for good.
    if (own_ == HostRole::kRunner && ::poll(&descriptor, 1, 0) != 1) return;
    shake_hands();
    if (is_open()) heard_at_ = now;
  }
  if (is_open()) send();
  if (is_open() && reads) receive(now);
}

void TlsLine::shake_hands() {
  ERR_clear_error();
  const int result = SSL_do_handshake(ssl_.get());
  if (result == 1) {
    const auto peer = check_peer();
    if (peer.ok()) {
      wants_write_ = false;
      peer_ = *peer;
      state_ = State::kOpen;
      return;
    }
    refused_ = true;
    return close(peer.error().message);
  }
  if (!waits(result)) fail(result, "handshake");
}

Result<std::string> TlsLine::check_peer() {
  const CertificatePtr certificate(SSL_get1_peer_certificate(ssl_.get()));
  if (certificate == nullptr) return Error{"the other end shows no certificate"};
  const HostRole role = own_ == HostRole::kHost ? HostRole::kRunner : HostRole::kHost;
  // Who vouches for it, and when it is valid, was checked with the handshake.
  const auto name = host_name_in(*certificate, role);
  if (!name) {
    return Error{"the other end shows the certificate of " + subject_text(*certificate) +
                 "; expected one of the kind '" + std::string(role_name(role)) + "'"};
  }
  if (!expected_.empty() && *name != expected_) {
    return Error{"the other end is " + std::string(role_name(role)) + " '" + *name +
                 "'; expected '" + expected_ + "'"};
  }
  return *name;
}

bool TlsLine::waits(int result) {
  const int error = SSL_get_error(ssl_.get(), result);
  wants_write_ = error == SSL_ERROR_WANT_WRITE;
  return error == SSL_ERROR_WANT_READ || error == SSL_ERROR_WANT_WRITE;
}

void TlsLine::fail(int result, const char* doing) {
  const int error = SSL_get_error(ssl_.get(), result);
  if (error == SSL_ERROR_ZERO_RETURN) {
    left_ = true;
    return close("the other end has closed the connection");
  }
  if (error == SSL_ERROR_SYSCALL) {
    const int number = errno;
    return close(number == 0 ? "the connection was cut" : std::strerror(number));
  }
  const long verified = SSL_get_verify_result(ssl_.get());
  if (verified != X509_V_OK) {
    refused_ = true;
    return close(std::string("the other end's certificate is refused: ") +
                 X509_verify_cert_error_string(verified));
  }
  const std::string reasons = all_reasons();
  // An alert of the other end: it does not believe our certificate.
  refused_ = reasons.find("alert") != std::string::npos;
  close((refused_ ? "the other end refuses this one: " : std::string(doing) + " failed: ") +
        reasons);
}

void TlsLine::send() {
  while (unsent_bytes() > 0) {
    ERR_clear_error();
    errno = 0;
    const auto size = static_cast<int>(std::min(unsent_bytes(), kMostAtOnce));
    const int sent = SSL_write(ssl_.get(), unsent_.data() + sent_of_unsent_, size);
    if (sent <= 0) {
      if (!waits(sent)) return fail(sent, "sending");
      // A peer that takes part of it each time must not let it grow for ever.
      if (sent_of_unsent_ > kMostReceivedAtOnce) {
        unsent_.erase(0, std::exchange(sent_of_unsent_, 0));
      }
      return;
    }
    sent_of_unsent_ += static_cast<std::size_t>(sent);
  }
  unsent_.clear();
  sent_of_unsent_ = 0;
  wants_write_ = false;
}

void TlsLine::receive(Time now) {
  std::array<char, 65536> buffer;
  for (std::size_t total = 0; total < kMostReceivedAtOnce;) {
    ERR_clear_error();
    errno = 0;
    const int got = SSL_read(ssl_.get(), buffer.data(), static_cast<int>(buffer.size()));
    if (got <= 0) {
      if (!waits(got)) fail(got, "receiving");
      return;
    }
    heard_at_ = now;
    received_.append(buffer.data(), static_cast<std::size_t>(got));
    total += static_cast<std::size_t>(got);
  }
}

std::optional<Frame> TlsLine::next() {
  auto frame = received_.next();
  if (const auto size = received_.too_large()) {
    close("the other end sends a frame of " + std::to_string(*size) +
          " bytes; allowed: " + std::to_string(received_.most_payload()));
  }
  return frame;
}

void TlsLine::post_bytes(FrameType type, std::string_view payload) {
  if (is_closed()) return;
  const auto header = FrameBuffer::header_of(type, payload);
  unsent_.append(header.data(), header.size()).append(payload);
  if (is_open()) send();
}

short events_passed_to(const TlsLine& line, const Link& link) {
  const bool takes = line.unsent_bytes() < kMostRelayedBytes;
  return static_cast<short>(takes ? link.poll_events() : link.poll_events() & ~POLLIN);
}

// With what came before still to be read by next().
void TlsLine::close(std::string why) {
  if (is_closed()) return;
  if (is_open() && unsent_bytes() == 0) SSL_shutdown(ssl_.get());
  ERR_clear_error();
  state_ = State::kClosed;
  why_ = std::move(why);
}

}  // namespace clew::bridge
