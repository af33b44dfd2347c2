// SPDX-License-Identifier: Apache-2.0
#include "control/heading_turn.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/angle.hpp"

namespace clew::control {
namespace {

using core::radians;

HeadingTurn heading_turn(double acceleration_radps2 = std::numeric_limits<double>::infinity()) {
  domain::BehaviourSetup setup;
  setup.tick_s = 0.5;
  setup.limits.turn_rate_radps = radians(90.0);
  setup.limits.turn_acceleration_radps2 = acceleration_radps2;
  return HeadingTurn(setup);
}

/// At (1, 0) within 0.2 m, facing up within 0.1 rad.
ActiveTarget target() { return {{1.0, 0.0}, 0.2, false, true, radians(90.0), 0.1}; }

core::Pose2 pose(double x_m, double heading_deg) { return {x_m, 0.0, radians(heading_deg)}; }

TEST(HeadingTurn, TurnsWhereTheRobotHasArrivedAsFastAsItCan) {
  HeadingTurn turn = heading_turn();

  EXPECT_FALSE(turn.step(pose(0.0, 0.0), target()));
  EXPECT_FALSE(turn.step(pose(0.85, 0.0), target()));  // within the radius, and still nearer
  const auto first = turn.step(pose(0.95, 0.0), target());
  const auto last = turn.step(pose(0.95, 100.0), target());

  ASSERT_TRUE(first);
  EXPECT_EQ(first->kind, domain::CommandKind::kTurnAndStep);
  EXPECT_DOUBLE_EQ(first->turn_rad, radians(45.0));  // 90 deg/s for 0.5 s
  EXPECT_EQ(first->step_m, 0.0);
  ASSERT_TRUE(last);
  EXPECT_NEAR(last->turn_rad, radians(-10.0), 1e-12);
}

TEST(HeadingTurn, BeginsAtTheRimWhereTheRobotComesNoNearer) {
  HeadingTurn turn = heading_turn();

  EXPECT_FALSE(turn.step(pose(0.82, 0.0), target()));
  EXPECT_TRUE(turn.step(pose(0.82, 0.0), target()));
}

TEST(HeadingTurn, IsNotForVirtualTargetsNorForThoseWithoutAHeading) {
  HeadingTurn turn = heading_turn();
  ActiveTarget is_virtual = target();
  is_virtual.is_virtual = true;
  ActiveTarget free = target();
  free.has_heading = false;

  EXPECT_FALSE(turn.step(pose(1.0, 0.0), is_virtual));
  EXPECT_FALSE(turn.step(pose(1.0, 0.0), free));
}

// Else a robot that has drifted would stand there for ever.
TEST(HeadingTurn, LetsTheControllerSteerOnceTheHeadingWasMetUntilTheRobotWasOutside) {
  HeadingTurn turn = heading_turn();

  EXPECT_TRUE(turn.step(pose(1.0, 0.0), target()));
  EXPECT_FALSE(turn.step(pose(1.0, 86.0), target()));
  EXPECT_FALSE(turn.step(pose(1.1, 0.0), target()));
  EXPECT_FALSE(turn.step(pose(1.3, 0.0), target()));
  EXPECT_TRUE(turn.step(pose(1.05, 180.0), target()));
}

TEST(HeadingTurn, EndsSoThatTheDriveCanBrake) {
  // 0.1 rad/s^2: from rest a tick brings 0.05 rad/s.
  HeadingTurn turn = heading_turn(0.1);
  double heading_rad = 0.0;
  double rate_radps = 0.0;
  double most_rad = 0.0;
  for (int tick = 0; tick < 200; ++tick) {
    const auto motion = turn.step({1.0, 0.0, heading_rad}, target());
    const double asked_radps = motion ? motion->turn_rad / 0.5 : 0.0;
    rate_radps += std::clamp(asked_radps - rate_radps, -0.05, 0.05);
    heading_rad += rate_radps * 0.5;
    most_rad = std::max(most_rad, heading_rad);
  }

  EXPECT_NEAR(heading_rad, radians(90.0), 0.1);
  EXPECT_LE(most_rad, radians(90.0) + 0.1);
}

}  // namespace
}  // namespace clew::control
