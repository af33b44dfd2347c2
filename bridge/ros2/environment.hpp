// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "core/result.hpp"

namespace clew::ros2 {

/// Which releases of ROS 2 differ on the wire.
enum class Distro { kJazzy, kHumble };

/// `jazzy` or `humble`.
core::Result<Distro> distro_from_name(const std::string& name);

/// What ROS 2's own variables say of the network.
struct RosNetwork {
  int domain = 0;           ///< ROS_DOMAIN_ID
  bool on_network = false;  ///< beyond 127.0.0.1
};

/// Looks a variable up; an empty text is none.
using Variables = std::function<std::string(const char* name)>;
std::string variable_of_process(const char* name);

/// Reads ROS_DOMAIN_ID, ROS_LOCALHOST_ONLY and ROS_AUTOMATIC_DISCOVERY_RANGE. Without the last two
/// it is 127.0.0.1 only: unlike ROS, which then speaks to the whole subnet. ROS_LOCALHOST_ONLY=1
/// comes before the range, as in rcl. Refused: values that rcl would not know either, and OFF.
core::Result<RosNetwork> read_ros_network(const Variables& variable);

}  // namespace clew::ros2
