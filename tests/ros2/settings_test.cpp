// SPDX-License-Identifier: Apache-2.0
#include "robot/settings.hpp"

#include <gtest/gtest.h>

#include "core/math.hpp"

namespace clew::robot {
namespace {

using Texts = std::map<std::string, std::string>;

core::Result<Settings> read(const Texts& texts, const std::string& ros_domain_id = "") {
  const auto variable = [&](const char* name) {
    return std::string(name) == "ROS_DOMAIN_ID" ? ros_domain_id : std::string();
  };
  return read_settings(texts, variable, "clew_drive");
}

TEST(RobotSettings, AreThoseOfMostRobotsIfNothingIsSaid) {
  const auto settings = read({}, "7");

  ASSERT_TRUE(settings.ok());
  EXPECT_EQ(settings->network.domain, 7);
  EXPECT_EQ(settings->node_name, "clew_drive");
  EXPECT_EQ(settings->scan_topic, "/scan");
  EXPECT_EQ(settings->odometry_topic, "/odom");
  EXPECT_EQ(settings->command_topic, "/cmd_vel");
  EXPECT_FALSE(settings->stamped);
  EXPECT_FALSE(settings->laser);
}

TEST(RobotSettings, NamesAreRelativeToTheNamespace) {
  const auto settings = read({{"namespace", "r1"}, {"scan", "front/scan"}, {"cmd_vel", "/go"}});

  ASSERT_TRUE(settings.ok());
  EXPECT_EQ(settings->node_namespace, "/r1");
  EXPECT_EQ(settings->scan_topic, "/r1/front/scan");
  EXPECT_EQ(settings->odometry_topic, "/r1/odom");
  EXPECT_EQ(settings->command_topic, "/go");
}

TEST(RobotSettings, OutrankTheEnvironment) {
  const auto settings = read({{"domain", "3"},
                              {"distro", "humble"},
                              {"middleware", "fastdds"},
                              {"command", "twist_stamped"},
                              {"timeout_s", "0.2"},
                              {"laser_x_m", "0.1"},
                              {"laser_heading_deg", "180"}},
                             "7");

  ASSERT_TRUE(settings.ok());
  EXPECT_EQ(settings->network.domain, 3);
  EXPECT_EQ(settings->distro, ros2::Distro::kHumble);
  EXPECT_EQ(settings->vendor, bridge::Vendor::kFastDds);
  EXPECT_TRUE(settings->stamped);
  EXPECT_EQ(settings->timeout_s, 0.2);
  ASSERT_TRUE(settings->laser);
  EXPECT_EQ(settings->laser->x_m, 0.1);
  EXPECT_NEAR(settings->laser->heading_rad, core::kPi, 1e-12);
}

TEST(RobotSettings, WhatIsNoneIsRefusedWithWhatIsAllowed) {
  const std::map<std::string, std::pair<Texts, std::string>> cases = {
      {"key", {{{"scna", "x"}}, "unknown key of ros2 'scna' (did you mean 'scan'?)"}},
      {"domain", {{{"domain", "100"}}, "domain is '100'; allowed: 0 to 99"}},
      {"part", {{{"domain", "1.5"}}, "allowed: a whole number from 0 to 99"}},
      {"topic", {{{"scan", "a-b"}}, "scan: 'a-b' is no name of ROS"}},
      {"namespace", {{{"namespace", "1r"}}, "namespace: '1r' is no name of ROS"}},
      {"distro", {{{"distro", "foxy"}}, "distro is 'foxy'; allowed: jazzy, humble"}},
      {"middleware", {{{"middleware", "rti"}}, "allowed: cyclonedds, fastdds"}},
      {"command", {{{"command", "ackermann"}}, "allowed: twist, twist_stamped"}},
      {"number", {{{"timeout_s", "soon"}}, "timeout_s is 'soon'; allowed: 0.05 to 10"}},
      {"laser", {{{"laser_x_m", "11"}}, "laser_x_m is '11'; allowed: -10 to 10"}}};
  for (const auto& [name, expected] : cases) {
    const auto settings = read(expected.first);
    ASSERT_FALSE(settings.ok()) << name;
    EXPECT_NE(settings.error().message.find(expected.second), std::string::npos)
        << settings.error().message;
  }
  const auto variable = read({}, "x");
  ASSERT_FALSE(variable.ok());
  EXPECT_NE(variable.error().message.find("ROS_DOMAIN_ID"), std::string::npos);
}

}  // namespace
}  // namespace clew::robot
