// SPDX-License-Identifier: Apache-2.0
/// What both vendors are told, so that they find each other on 127.0.0.1 and nowhere else.
#pragma once

#include <chrono>
#include <cstdint>
#include <string_view>

namespace clew::bridge {

inline constexpr const char* kLoopbackAddress = "127.0.0.1";

/// Domains above 99 would use ports that the kernel hands out to others.
inline constexpr int kMaxDomain = 99;

/// The last participant index of a domain: its ports end where those of the next domain begin.
inline constexpr int kMaxParticipantIndex = 119;

/// The port on which participant `index` of `domain` listens for discovery (RTPS 2.2, 9.6.1.1).
constexpr std::uint32_t discovery_port(int domain, int index) {
  return static_cast<std::uint32_t>(7400 + 250 * domain + 10 + 2 * index);
}

/// How long a new participant waits before it may have endpoints. Fast DDS answers the endpoints of
/// a participant that it has just met with the next of its heartbeats, a second later, unless both
/// know each other by then.
inline constexpr std::chrono::milliseconds kSettlingTime{100};

/// How long a writer that is closed waits at most until its readers have its last samples. A dead
/// reader is waited for, too, until its lease ends.
inline constexpr std::chrono::milliseconds kLinger{500};

/// `RELIABILITY` for 11: both vendors use the numbers of the DDS and DDS-XTypes standards.
constexpr std::string_view qos_policy_name(std::uint32_t policy_id) {
  constexpr std::string_view kNames[] = {"UNKNOWN",
                                         "USER_DATA",
                                         "DURABILITY",
                                         "PRESENTATION",
                                         "DEADLINE",
                                         "LATENCY_BUDGET",
                                         "OWNERSHIP",
                                         "OWNERSHIP_STRENGTH",
                                         "LIVELINESS",
                                         "TIME_BASED_FILTER",
                                         "PARTITION",
                                         "RELIABILITY",
                                         "DESTINATION_ORDER",
                                         "HISTORY",
                                         "RESOURCE_LIMITS",
                                         "ENTITY_FACTORY",
                                         "WRITER_DATA_LIFECYCLE",
                                         "READER_DATA_LIFECYCLE",
                                         "TOPIC_DATA",
                                         "GROUP_DATA",
                                         "TRANSPORT_PRIORITY",
                                         "LIFESPAN",
                                         "DURABILITY_SERVICE",
                                         "DATA_REPRESENTATION",
                                         "TYPE_CONSISTENCY_ENFORCEMENT"};
  return policy_id < std::size(kNames) ? kNames[policy_id] : kNames[0];
}

/// The participant property in which both vendors tell their process id; Cyclone DDS came first.
inline constexpr const char* kProcessIdProperty = "__Pid";

}  // namespace clew::bridge
