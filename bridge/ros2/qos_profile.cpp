// SPDX-License-Identifier: Apache-2.0
#include "ros2/qos_profile.hpp"

#include <fmt/format.h>

namespace clew::ros2 {

std::string offered_qos_yaml(const QosProfile& profile) {
  constexpr char kInfinite[] = "{sec: 9223372036, nsec: 854775807}";
  return fmt::format(
      "- history: keep_last\n  depth: {}\n  reliability: {}\n  durability: {}\n  deadline: {}\n"
      "  lifespan: {}\n  liveliness: automatic\n  liveliness_lease_duration: {}\n"
      "  avoid_ros_namespace_conventions: false\n",
      profile.depth, profile.reliable ? "reliable" : "best_effort",
      profile.transient_local ? "transient_local" : "volatile", kInfinite, kInfinite, kInfinite);
}

}  // namespace clew::ros2
