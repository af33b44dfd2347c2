// SPDX-License-Identifier: Apache-2.0
#include "recover/escapes/following/wall_follower.hpp"

#include <gtest/gtest.h>

#include "tests/recover/scene.hpp"
#include "tests/source_files.hpp"

namespace clew::recover {
namespace {

using tests::rule_base;
using tests::with;

using core::radians;

constexpr double kTolerance = 1e-12;

WallRules rules() { return WallRules::parse(rule_base("obstacle_following")).value(); }
WallFollower follower() { return WallFollower(rules()); }

domain::Motion follow(std::initializer_list<double> readings, Side side) {
  return follower().follow(Scene().sees(readings).scan(), side);
}

std::string refusal_of(const std::string& from, const std::string& to) {
  const auto parsed =
      WallRules::parse({"rules.yaml", with(rule_base("obstacle_following").text, from, to)});
  return parsed.ok() ? "accepted" : parsed.error().message;
}

TEST(WallFollower, GoesStraightOnAtTheRightDistance) {
  const domain::Motion motion = follow({0.32, 0.5, 0.8, 1, 1, 1, 1}, Side::kLeft);

  EXPECT_EQ(motion.kind, domain::CommandKind::kTurnAndStep);
  EXPECT_NEAR(motion.turn_rad, 0.0, kTolerance);
  EXPECT_NEAR(motion.step_m, 0.1, kTolerance);
}

TEST(WallFollower, TurnsTowardAWallThatIsTooFar) {
  // Half way from good (0.32) to far (0.47): half of 12 degrees.
  EXPECT_NEAR(follow({0.395, 0.5, 0.8, 1, 1, 1, 1}, Side::kLeft).turn_rad, radians(6.0),
              kTolerance);
  EXPECT_NEAR(follow({0.9, 0.9, 0.9, 1, 1, 1, 1}, Side::kLeft).turn_rad, radians(12.0), kTolerance);
}

TEST(WallFollower, TurnsAwayFromAWallThatIsTooClose) {
  // A fifth of the way from good (0.32) to close (0.17).
  EXPECT_NEAR(follow({0.29, 0.5, 0.8, 1, 1, 1, 1}, Side::kLeft).turn_rad, radians(-2.4),
              kTolerance);
  EXPECT_NEAR(follow({0.1, 0.5, 0.8, 1, 1, 1, 1}, Side::kLeft).turn_rad, radians(-12.0),
              kTolerance);
}

TEST(WallFollower, TurnsAwaySlowlyWhereTheWayAheadIsBlocked) {
  const domain::Motion blocked = follow({0.32, 0.3, 0.25, 0.25, 0.4, 1, 1}, Side::kLeft);
  const domain::Motion half = follow({0.32, 0.3, 0.3, 0.4, 0.4, 1, 1}, Side::kLeft);

  EXPECT_NEAR(blocked.turn_rad, radians(-20.0), kTolerance);
  EXPECT_NEAR(blocked.step_m, 0.05, kTolerance);
  // Half blocked at 0.30 between 0.27 and 0.33; the side reading is good.
  EXPECT_NEAR(half.turn_rad, radians(-10.0), kTolerance);
  EXPECT_NEAR(half.step_m, 0.075, kTolerance);
}

TEST(WallFollower, IsMirroredOnTheRight) {
  const domain::Motion left = follow({0.4, 0.5, 0.31, 1, 0.9, 0.8, 0.7}, Side::kLeft);
  const domain::Motion right = follow({0.7, 0.8, 0.9, 1, 0.31, 0.5, 0.4}, Side::kRight);

  EXPECT_EQ(right.turn_rad, -left.turn_rad);
  EXPECT_EQ(right.step_m, left.step_m);
}

TEST(WallFollower, SeesABreakWhereBothOuterReadingsAreBeyondIt) {
  const Scene broken = Scene().sees({0.68, 0.7, 0.2, 1, 1, 0.1, 0.1});
  const Scene whole = Scene().sees({0.68, 0.6, 1, 1, 1, 1, 1});

  EXPECT_TRUE(follower().at_break(broken.scan(), Side::kLeft));
  EXPECT_FALSE(follower().at_break(broken.scan(), Side::kRight));
  EXPECT_FALSE(follower().at_break(whole.scan(), Side::kLeft));
}

TEST(WallFollower, SeesAnObstacleUpToTheBreakDistance) {
  EXPECT_TRUE(follower().sees_obstacle(Scene().sees({1, 1, 1, 0.67, 1, 1, 1}).scan()));
  EXPECT_FALSE(follower().sees_obstacle(Scene().sees({1, 1, 1, 0.68, 1, 1, 1}).scan()));
}

TEST(WallRules, ScaleDistancesAndStepsButNotTurns) {
  const WallRules half = rules().scaled(0.5);

  EXPECT_EQ(half.good_ratio, 0.16);
  EXPECT_EQ(half.break_ratio, 0.335);
  EXPECT_EQ(half.free_step_m, 0.05);
  EXPECT_EQ(half.far_turn_rad, rules().far_turn_rad);
}

TEST(WallRules, RefuseWhatIsNoRuleBase) {
  EXPECT_EQ(refusal_of("clew-obstacle-following/1", "clew-walls/1"),
            "found 'clew-walls/1', expected clew-obstacle-following/1");
  EXPECT_EQ(refusal_of("blocked_none_ratio: 0.33", "blocked_none_ratio: 0.27"),
            "blocked_none_ratio must be more than blocked_full_ratio");
  EXPECT_EQ(refusal_of("far_ratio: 0.47", "far_ratio: 0.3"),
            "close_ratio, good_ratio, far_ratio and break_ratio must rise");
  EXPECT_EQ(refusal_of("free_step_m: 0.10", "free_step_m: -1"),
            "found -1, expected a number from 0 to 1");
  EXPECT_NE(refusal_of("free_step_m: 0.10", "").find("free_step_m"), std::string::npos);
}

}  // namespace
}  // namespace clew::recover
