// SPDX-License-Identifier: Apache-2.0
#include "ros2/environment.hpp"

#include <gtest/gtest.h>

#include <map>

namespace clew::ros2 {
namespace {

core::Result<RosNetwork> read(const std::map<std::string, std::string>& variables) {
  return read_ros_network([&](const char* name) {
    const auto found = variables.find(name);
    return found == variables.end() ? std::string() : found->second;
  });
}

TEST(RosNetwork, IsDomain0OnLoopbackUnlessSaidOtherwise) {
  const auto network = read({});

  ASSERT_TRUE(network.ok());
  EXPECT_EQ(network->domain, 0);
  EXPECT_FALSE(network->on_network);
}

TEST(RosNetwork, FollowsTheVariablesOfRos) {
  EXPECT_EQ(read({{"ROS_DOMAIN_ID", "42"}})->domain, 42);
  EXPECT_TRUE(read({{"ROS_AUTOMATIC_DISCOVERY_RANGE", "SUBNET"}})->on_network);
  EXPECT_TRUE(read({{"ROS_AUTOMATIC_DISCOVERY_RANGE", "SYSTEM_DEFAULT"}})->on_network);
  EXPECT_FALSE(read({{"ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST"}})->on_network);
  EXPECT_TRUE(read({{"ROS_LOCALHOST_ONLY", "0"}})->on_network);
}

TEST(RosNetwork, LocalhostOnlyComesBeforeTheRange) {
  EXPECT_FALSE(
      read({{"ROS_LOCALHOST_ONLY", "1"}, {"ROS_AUTOMATIC_DISCOVERY_RANGE", "SUBNET"}})->on_network);
  EXPECT_FALSE(read({{"ROS_LOCALHOST_ONLY", "0"}, {"ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST"}})
                   ->on_network);
}

TEST(RosNetwork, RefusesOtherValuesByName) {
  const auto domain = read({{"ROS_DOMAIN_ID", "4x"}});
  const auto range = read({{"ROS_AUTOMATIC_DISCOVERY_RANGE", "subnet"}});

  ASSERT_FALSE(domain.ok());
  EXPECT_EQ(domain.error().text(),
            "ROS_DOMAIN_ID: found '4x'; allowed: the number of a DDS domain");
  ASSERT_FALSE(range.ok());
  EXPECT_EQ(range.error().file, "ROS_AUTOMATIC_DISCOVERY_RANGE");
  EXPECT_FALSE(read({{"ROS_LOCALHOST_ONLY", "yes"}}).ok());
  EXPECT_FALSE(read({{"ROS_AUTOMATIC_DISCOVERY_RANGE", "OFF"}}).ok());
}

}  // namespace
}  // namespace clew::ros2
