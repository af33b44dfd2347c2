// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <ctime>
#include <stdexcept>
#include <string>
#include <utility>

#include "hosts/tcp_socket.hpp"
#include "hosts/tls_line.hpp"
#include "temporary_keys.hpp"

namespace clew::bridge {

using Clock = std::chrono::steady_clock;

/// What a computer of that name, with an identity of these keys, connects with.
inline TlsContextPtr context_of(const TemporaryKeys& keys, const std::string& name, HostRole role) {
  const auto minted = mint_host_identity(keys.path(), name, role, days_around_now(1, 10));
  EXPECT_TRUE(minted.ok()) << minted.error().text();
  const auto identity = HostIdentity::read(host_identity_directory(keys.path(), name, role), role,
                                           std::time(nullptr));
  if (!identity.ok()) throw std::runtime_error(identity.error().text());
  auto context = make_tls_context(*identity, role);
  if (!context.ok()) throw std::runtime_error(context.error().text());
  return std::move(context).value();
}

/// The ends of a TCP connection on this computer. Whoever makes them closes them.
struct Sockets {
  Sockets() {
    const auto listening = listen_on({"127.0.0.1", 0});
    if (!listening.ok()) throw std::runtime_error(listening.error().text());
    const auto connecting = begin_connecting(own_end(*listening));
    const auto deadline = Clock::now() + std::chrono::seconds(20);
    while (connecting.ok() && host < 0 && Clock::now() < deadline) host = accept_next(*listening);
    ::close(*listening);
    if (!connecting.ok()) throw std::runtime_error(connecting.error().text());
    relay = *connecting;
    if (host >= 0) return;
    ::close(relay);
    throw std::runtime_error("nobody was accepted for 20 s");
  }

  int relay = -1;
  int host = -1;
};

}  // namespace clew::bridge
