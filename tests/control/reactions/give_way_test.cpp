// SPDX-License-Identifier: Apache-2.0
#include "control/reactions/give_way.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace clew::control {
namespace {

using core::Vec2;
using domain::MovingObject;
using domain::ObjectMotion;

constexpr double kRange_m = 4.0;
constexpr double kRobot_m = 0.15;
constexpr double kTick_s = 0.3;
constexpr double kSpeed_mps = 0.4;

domain::BehaviourSetup setup() {
  domain::BehaviourSetup setup;
  setup.tick_s = kTick_s;
  setup.robot.radius_m = kRobot_m;
  setup.limits.speed_mps = kSpeed_mps;
  setup.limits.turn_rate_radps = core::radians(100.0);
  return setup;
}

/// A robot that wants to go straight ahead at full speed, in the open.
class GiveWayTest : public ::testing::Test {
 protected:
  GiveWayTest() : reaction_({}, setup()) {
    scan_.bearing_first_rad = 0.5 * core::kPi;
    scan_.bearing_step_rad = -core::kPi / 360.0;
    scan_.range_max_m = kRange_m;
    scan_.ranges_m.assign(361, kRange_m);
    wanted_.kind = domain::CommandKind::kTurnAndStep;
    wanted_.step_m = kSpeed_mps * kTick_s;
  }

  /// Something at `now` that moves steadily, seen as `motion`.
  void see(ObjectMotion motion, const Vec2& now, const Vec2& velocity_mps) {
    MovingObject object;
    object.motion = motion;
    object.bearing_rad = std::atan2(now.y(), now.x());
    for (std::size_t i = 0; i < 3; ++i) {
      const double before_s = 0.5 * static_cast<double>(2 - i);
      object.ranges_m[i] = (now - before_s * velocity_mps).norm() - kRobot_m;
    }
    landmark_.recognitions.push_back(domain::to_recognition(object, kRange_m));
  }
  std::optional<domain::Motion> react() { return reaction_.react({}, scan_, landmark_, wanted_); }

  GiveWay reaction_;
  domain::Scan scan_;
  domain::Landmark landmark_;
  domain::Motion wanted_;
};

TEST_F(GiveWayTest, NothingAroundLetsTheMotionPass) { EXPECT_FALSE(react().has_value()); }

TEST_F(GiveWayTest, WhatRecedesOrStandsLetsItPass) {
  see(ObjectMotion::kReceding, {0.8, 0.0}, {0.5, 0.0});
  see(ObjectMotion::kStatic, {0.9, 0.2}, {0.0, 0.0});

  EXPECT_FALSE(react().has_value());
}

TEST_F(GiveWayTest, TellsWhomItGivesWayToAndWhatThatLeaves) {
  const auto told = [&](const core::Pose2& pose) {
    domain::Inside inside;
    domain::Odometry odometry;
    odometry.pose_odom_robot = pose;
    reaction_.tell(odometry, scan_, landmark_, wanted_, inside);
    return inside;
  };
  EXPECT_EQ(told({}).text, "Nothing comes near, so there is nobody to give way to.");

  // They would not meet within the horizon.
  see(ObjectMotion::kApproaching, {3.5, 0.0}, {-0.1, 0.0});
  const std::string passing = told({}).text;
  EXPECT_EQ(passing.find("Of 1 moving object, the nearest will leave "), 0u) << passing;
  EXPECT_EQ(passing.find("Going aside"), std::string::npos) << passing;

  see(ObjectMotion::kApproaching, {2.0, 0.0}, {-0.6, 0.0});
  ASSERT_TRUE(react().has_value());
  const domain::Inside meeting = told({10.0, 20.0, 0.5 * core::kPi});
  EXPECT_EQ(meeting.text.find("Of 2 moving objects, the nearest will leave "), 0u) << meeting.text;
  EXPECT_TRUE(meeting.text.find("Going aside leaves ") != std::string::npos ||
              meeting.text.find("Waiting leaves ") != std::string::npos)
      << meeting.text;
  // What is 2 m ahead of a robot that looks along y.
  ASSERT_EQ(meeting.picture.layers.size(), 2u);
  const Vec2 seen = meeting.picture.layers[1].places_odom.at(0);
  EXPECT_NEAR(seen.x(), 10.0, 0.1);
  EXPECT_NEAR(seen.y(), 22.0, 0.5);
}

TEST_F(GiveWayTest, GoesAsideForWhatApproaches) {
  // They would meet after 2 s. To keep 0.25 m of room at 0.4 m/s the robot must leave the line.
  see(ObjectMotion::kApproaching, {2.0, 0.0}, {-0.6, 0.0});

  const auto motion = react();

  ASSERT_TRUE(motion.has_value());
  EXPECT_GE(std::fabs(motion->turn_rad), core::radians(14.0));
}

TEST_F(GiveWayTest, PassesBehindOrWaitsForWhatCrosses) {
  // It crosses to the left and would be ahead of the robot when that is there: after 2.5 s.
  see(ObjectMotion::kCrossingLeft, {1.0, -1.25}, {0.0, 0.5});

  const auto motion = react();

  // A turn to the left would run along with it.
  ASSERT_TRUE(motion.has_value());
  EXPECT_TRUE(motion->turn_rad < 0.0 || motion->step_m == 0.0) << motion->turn_rad;
}

TEST_F(GiveWayTest, WhatCrossesBehindLetsItPass) {
  see(ObjectMotion::kCrossingLeft, {-1.5, -1.0}, {0.0, 0.5});

  EXPECT_FALSE(react().has_value());
}

TEST_F(GiveWayTest, WhatComesLaterThanTheHorizonLetsItPass) {
  // 3 s at 0.4 + 0.1 m/s leave 3.5 - 1.5 m between the centres.
  see(ObjectMotion::kApproaching, {3.5, 0.0}, {-0.1, 0.0});

  EXPECT_FALSE(react().has_value());
}

TEST_F(GiveWayTest, DoesNotGoAsideIntoAWall) {
  // A corridor 0.8 m wide: aside is no room, so it does not leave its line for a wall.
  see(ObjectMotion::kApproaching, {1.6, 0.0}, {-0.6, 0.0});
  for (std::size_t i = 0; i < scan_.ranges_m.size(); ++i) {
    const double across = std::fabs(std::sin(scan_.bearing_rad(i)));
    if (across > 0.15) scan_.ranges_m[i] = std::min(kRange_m, 0.4 / across - kRobot_m);
  }

  const auto motion = react();

  ASSERT_TRUE(motion.has_value());
  const bool goes = motion->step_m > 0.0;
  EXPECT_TRUE(!goes || std::fabs(motion->turn_rad) < core::radians(45.0)) << motion->turn_rad;
}

TEST_F(GiveWayTest, LandmarksAreNoMovingObjects) {
  see(ObjectMotion::kApproaching, {1.0, 0.0}, {-0.6, 0.0});
  landmark_.presented = true;

  EXPECT_FALSE(react().has_value());
}

TEST_F(GiveWayTest, AMotionInVelocitiesIsJudgedAlike) {
  see(ObjectMotion::kApproaching, {2.0, 0.0}, {-0.6, 0.0});
  wanted_ = {};
  wanted_.kind = domain::CommandKind::kVelocities;
  wanted_.speed_mps = kSpeed_mps;

  EXPECT_TRUE(react().has_value());
}

/// What it tells of its inside: the text, and the names of its values.
std::string told_by(const GiveWay& reaction, const domain::Odometry& odometry,
                    const domain::Scan& scan, const domain::Landmark& landmark,
                    const domain::Motion& wanted, domain::Inside& inside) {
  reaction.tell(odometry, scan, landmark, wanted, inside);
  std::string names;
  for (const domain::InsideValue& value : inside.values.values()) names += value.name + ' ';
  return names;
}

TEST_F(GiveWayTest, TellsThatNothingComesNear) {
  domain::Inside inside;

  EXPECT_EQ(told_by(reaction_, {}, scan_, landmark_, wanted_, inside), "movers keep ");
  EXPECT_EQ(inside.text, "Nothing comes near, so there is nobody to give way to.");
}

TEST_F(GiveWayTest, TellsWhatTheWantedMotionAndTheChosenOneLeaveFree) {
  see(ObjectMotion::kApproaching, {2.0, 0.0}, {-0.6, 0.0});
  domain::Odometry odometry;
  odometry.pose_odom_robot = {1.0, 1.0, 0.5 * core::kPi};
  domain::Inside inside;

  EXPECT_EQ(told_by(reaction_, odometry, scan_, landmark_, wanted_, inside),
            "movers keep clearance_as_wanted clearance_chosen deviation ");
  EXPECT_EQ(inside.text.rfind("Of 1 moving object, the nearest will leave ", 0), 0U) << inside.text;
  EXPECT_NE(inside.text.find("leaves"), std::string::npos);
  // The object is 2 m ahead of a robot that looks along y; in 3 s it comes 1.8 m nearer.
  ASSERT_EQ(inside.picture.layers.size(), 1U);
  const auto& way = inside.picture.layers[0].places_odom;
  ASSERT_EQ(way.size(), 2U);
  EXPECT_NEAR(way[0].x(), 1.0, 0.05);
  EXPECT_NEAR(way[0].y(), 3.0, 0.3);
  EXPECT_LT(way[1].y(), way[0].y() - 1.0);
}

}  // namespace
}  // namespace clew::control
