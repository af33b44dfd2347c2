// SPDX-License-Identifier: Apache-2.0
/// What a stranger may cost, each with its reason.
#pragma once

#include <chrono>
#include <cstddef>

namespace clew::bridge {

/// Connections at once: a browser makes six; beyond this each is told that the server is busy.
inline constexpr std::size_t kMostConnections = 128;
/// A browser's cookies of all programs on this host fit in.
inline constexpr std::size_t kMostHeaderBytes = 32 * 1024;
/// A world that was drawn by hand is some kilobytes.
inline constexpr std::size_t kMostBodyBytes = 1024 * 1024;
/// A client of a web socket sends subscriptions and commands.
inline constexpr std::size_t kMostFrameBytes = 256 * 1024;
/// A connection that sends nothing for so long is closed.
inline constexpr auto kIdleTimeout = std::chrono::seconds(30);
/// Where this process may open no more files, the next connection waits so long for another try.
inline constexpr auto kAcceptAgainAfter = std::chrono::milliseconds(100);
/// A client that queues more than this is not reading any more, and is closed.
inline constexpr std::size_t kMostQueuedBytes = 64 * 1024 * 1024;
/// A viewer with more than this under way gets nothing new.
inline constexpr std::size_t kMostUnderWayBytes = 4 * 1024 * 1024;
/// A piece of a file that is sent at once.
inline constexpr std::size_t kMostRangeBytes = 8 * 1024 * 1024;

}  // namespace clew::bridge
