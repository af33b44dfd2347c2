// SPDX-License-Identifier: Apache-2.0
/// Where participants listen: domains, ports and the one address (RTPS 2.3, section 9.6.1.1).
#pragma once

#include <cstdint>

#include "core/result.hpp"

namespace clew::bridge {

inline constexpr const char* kLoopbackAddress = "127.0.0.1";

/// Domains above 99 would use ports that the kernel hands out to others.
inline constexpr int kMaxDomain = 99;

/// Refuses a DDS domain whose ports the kernel may hand out to others.
core::Result<void> check_domain(int domain);

/// A domain's ports start at kPortBase + kPortsPerDomain times its number.
inline constexpr int kPortBase = 7400;
inline constexpr int kPortsPerDomain = 250;

/// The last participant index of a domain: its ports end where those of the next domain begin.
inline constexpr int kMaxParticipantIndex = 119;

/// The same of a run over several hosts, where each announcement goes to every port of every host.
inline constexpr int kMaxIndexOverHosts = 31;

/// The port on which participant `index` of `domain` listens for discovery.
constexpr std::uint32_t discovery_port(int domain, int index) {
  return static_cast<std::uint32_t>(kPortBase + kPortsPerDomain * domain + 10 + 2 * index);
}

}  // namespace clew::bridge
