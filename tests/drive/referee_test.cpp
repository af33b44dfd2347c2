// SPDX-License-Identifier: Apache-2.0
#include "drive/referee.hpp"

#include <gtest/gtest.h>

namespace clew::drive {
namespace {

using domain::CommandKind;
using domain::Outcome;

constexpr std::uint64_t kMaxTicks = 100;
const Mission kMission{{{{3.0, 4.0}, 0.5}}, kMaxTicks};
const Mission kTour{{{{1.0, 0.0}, 0.2}, {{2.0, 0.0}, 0.5}, {{3.0, 4.0}, 0.5}}, kMaxTicks};

// From here the target is 5 m away.
const core::Pose2 kFar{0.0, 0.0, 0.0};
// From here 0.5 m: just arrived.
const core::Pose2 kArrived{3.0, 3.5, 1.0};

/// A robot that knows where it is.
Referee::Place at(const core::Pose2& pose) { return {pose, pose}; }

domain::Motion commanded(CommandKind kind = CommandKind::kTurnAndStep) {
  domain::Motion motion;
  motion.kind = kind;
  return motion;
}

TEST(Referee, LetsARobotGoOnThatIsOnItsWay) {
  EXPECT_EQ(Referee(kMission).judge(5, at(kFar), 0, commanded()), Outcome::kRunning);
}

TEST(Referee, CallsTheTargetReachedFromItsRadiusOn) {
  const core::Pose2 short_of_it{3.0, 3.499, 1.0};

  EXPECT_EQ(Referee(kMission).judge(5, at(kArrived), 0, commanded()), Outcome::kReached);
  EXPECT_EQ(Referee(kMission).judge(5, at(short_of_it), 0, commanded()), Outcome::kRunning);
}

TEST(Referee, EndsTheRunAtItsLastTick) {
  EXPECT_EQ(Referee(kMission).judge(kMaxTicks - 1, at(kFar), 0, commanded()), Outcome::kRunning);
  EXPECT_EQ(Referee(kMission).judge(kMaxTicks, at(kFar), 0, commanded()), Outcome::kTimeout);
}

TEST(Referee, TakesTheRobotsWordThatTheTargetIsUnreachable) {
  EXPECT_EQ(Referee(kMission).judge(5, at(kFar), 0, commanded(CommandKind::kGiveUp)),
            Outcome::kUnreachable);
}

TEST(Referee, LetsARobotRestThatIsLateOrStops) {
  EXPECT_EQ(Referee(kMission).judge(5, at(kFar), 0, commanded(CommandKind::kStop)),
            Outcome::kRunning);
}

TEST(Referee, JudgesACollisionBeforeAnythingElse) {
  EXPECT_EQ(Referee(kMission).judge(kMaxTicks, at(kArrived), 1, commanded(CommandKind::kGiveUp)),
            Outcome::kCollided);
}

TEST(Referee, JudgesArrivalBeforeGivingUpAndTheLastTick) {
  EXPECT_EQ(Referee(kMission).judge(kMaxTicks, at(kArrived), 0, commanded(CommandKind::kGiveUp)),
            Outcome::kReached);
}

TEST(Referee, JudgesGivingUpBeforeTheLastTick) {
  EXPECT_EQ(Referee(kMission).judge(kMaxTicks, at(kFar), 0, commanded(CommandKind::kGiveUp)),
            Outcome::kUnreachable);
}

TEST(Referee, AnnouncesTheMissionsTarget) {
  domain::Target target;

  Referee(kMission).announce(kFar, target);

  EXPECT_EQ(target.x_m, 3.0);
  EXPECT_EQ(target.y_m, 4.0);
  EXPECT_EQ(target.radius_m, 0.5);
}

TEST(Referee, LeadsToOneWaypointAfterTheOther) {
  Referee referee(kTour);
  domain::Target target;

  EXPECT_EQ(referee.judge(5, at({0.8, 0.0, 0.0}), 0, commanded()), Outcome::kRunning);
  referee.announce(kFar, target);
  EXPECT_EQ(target.position(), core::Vec2(2.0, 0.0));
  EXPECT_EQ(target.radius_m, 0.5);

  EXPECT_EQ(referee.judge(6, at({2.0, 0.5, 0.0}), 0, commanded()), Outcome::kRunning);
  referee.announce(kFar, target);
  EXPECT_EQ(target.position(), core::Vec2(3.0, 4.0));

  EXPECT_EQ(referee.judge(7, at(kArrived), 0, commanded()), Outcome::kReached);
}

TEST(Referee, DoesNotEndATourAtItsLastPointBeforeTheOthers) {
  Referee referee(kTour);

  EXPECT_EQ(referee.judge(5, at(kArrived), 0, commanded()), Outcome::kRunning);
  EXPECT_EQ(referee.route().passed(), 0u);
}

TEST(Referee, PassesSeveralWaypointsAtOnceThatLieInOnePlace) {
  Referee referee({{{{1.0, 0.0}, 0.2}, {{1.0, 0.1}, 0.2}, {{1.1, 0.0}, 0.2}}, kMaxTicks});

  EXPECT_EQ(referee.judge(5, at({1.0, 0.0, 0.0}), 0, commanded()), Outcome::kReached);
}

TEST(Referee, LetsARobotWithoutAMissionWaitWhateverItSays) {
  Referee referee({{}, kMaxTicks});
  domain::Target target;
  referee.announce({7.0, 8.0, 1.0}, target);

  EXPECT_TRUE(referee.waits());
  EXPECT_EQ(referee.judge(5, at(kFar), 0, commanded(CommandKind::kGiveUp)), Outcome::kRunning);
  EXPECT_EQ(referee.judge(kMaxTicks, at(kFar), 0, commanded()), Outcome::kTimeout);
  EXPECT_EQ(target.position(), core::Vec2(7.0, 8.0));
}

TEST(Referee, WantsTheHeadingToo) {
  Mission mission = kTour;
  mission.waypoints[0].heading = {3.0, 0.2};
  mission.waypoints[2].heading = {1.5, 0.1};
  Referee referee(mission);
  domain::Target target;

  referee.announce(kFar, target);
  EXPECT_TRUE(target.has_heading);
  EXPECT_EQ(target.heading_rad, 3.0);
  EXPECT_EQ(target.heading_tolerance_rad, 0.2);
  EXPECT_EQ(target.waypoint, 1u);
  EXPECT_EQ(target.waypoints, 3u);

  // 0.2 rad from 3 across pi; at the first way-point.
  referee.judge(1, {{1.0, 0.0, 2.7}, {1.0, 0.0, 2.7}}, 0, commanded());
  EXPECT_EQ(referee.route().passed(), 0u);
  referee.judge(2, {{1.0, 0.0, -3.1}, {1.0, 0.0, -3.1}}, 0, commanded());
  EXPECT_EQ(referee.route().passed(), 1u);
  referee.announce(kFar, target);
  EXPECT_FALSE(target.has_heading);
  EXPECT_EQ(target.heading_rad, 0.0);
  EXPECT_EQ(target.waypoint, 2u);

  referee.judge(3, {{2.0, 0.0, 0.0}, {2.0, 0.0, 0.0}}, 0, commanded());
  EXPECT_EQ(referee.judge(4, {{3.0, 4.0, 1.35}, {3.0, 4.0, 1.35}}, 0, commanded()),
            Outcome::kRunning);
  EXPECT_EQ(referee.judge(5, {{3.0, 4.0, 1.45}, {3.0, 4.0, 1.45}}, 0, commanded()),
            Outcome::kReached);
}

}  // namespace
}  // namespace clew::drive
