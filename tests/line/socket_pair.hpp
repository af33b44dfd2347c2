// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <sys/socket.h>

#include <memory>
#include <utility>

#include "line/link.hpp"

namespace clew::bridge {

using LinkPair = std::pair<std::unique_ptr<Link>, std::unique_ptr<Link>>;

/// Both ends of a line; the first refuses payloads larger than `most_payload_bytes`.
inline LinkPair connected_links(std::size_t most_payload_bytes = kMostPayloadBytes) {
  int sockets[2] = {-1, -1};
  EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets), 0);
  return {std::make_unique<Link>(sockets[0], most_payload_bytes),
          std::make_unique<Link>(sockets[1])};
}

}  // namespace clew::bridge
