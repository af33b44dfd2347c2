// SPDX-License-Identifier: Apache-2.0
#include "ros2/environment.hpp"

#include <charconv>
#include <cstdlib>

namespace clew::ros2 {
namespace {

core::Error wrong_value(const char* variable, const std::string& value, const char* allowed) {
  return {"found '" + value + "'; allowed: " + allowed, variable};
}

}  // namespace

std::string variable_of_process(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

core::Result<Distro> distro_from_name(const std::string& name) {
  if (name == "jazzy") return Distro::kJazzy;
  if (name == "humble") return Distro::kHumble;
  return core::Error{"no distribution '" + name + "'; known: humble, jazzy"};
}

core::Result<RosNetwork> read_ros_network(const Variables& variable) {
  RosNetwork network;
  if (const std::string text = variable("ROS_DOMAIN_ID"); !text.empty()) {
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, network.domain);
    if (error != std::errc() || stop != end) {
      return wrong_value("ROS_DOMAIN_ID", text, "the number of a DDS domain");
    }
  }
  const std::string range = variable("ROS_AUTOMATIC_DISCOVERY_RANGE");
  const std::string localhost = variable("ROS_LOCALHOST_ONLY");
  if (!localhost.empty() && localhost != "0" && localhost != "1") {
    return wrong_value("ROS_LOCALHOST_ONLY", localhost, "0 and 1");
  }
  if (range == "OFF") {
    return wrong_value("ROS_AUTOMATIC_DISCOVERY_RANGE", range,
                       "LOCALHOST, SUBNET and SYSTEM_DEFAULT: with OFF nobody finds the bridge");
  }
  if (range == "SUBNET" || range == "SYSTEM_DEFAULT") {
    network.on_network = true;
  } else if (!range.empty() && range != "LOCALHOST") {
    return wrong_value("ROS_AUTOMATIC_DISCOVERY_RANGE", range,
                       "LOCALHOST, SUBNET and SYSTEM_DEFAULT");
  }
  if (range.empty() && localhost == "0") network.on_network = true;
  if (localhost == "1") network.on_network = false;
  return network;
}

}  // namespace clew::ros2
