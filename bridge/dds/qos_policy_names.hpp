// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <iterator>
#include <string_view>

namespace clew::bridge {

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

}  // namespace clew::bridge
