// SPDX-License-Identifier: Apache-2.0
#include "recover/escapes/following/obstacle_following.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/recover/scene.hpp"
#include "tests/source_files.hpp"

namespace clew::recover {
namespace {

using tests::rule_base;

using core::radians;

ObstacleFollowing make(LeavingRule leave = LeavingRule::kNearer) {
  ObstacleFollowingParameters parameters;
  parameters.leave = leave;
  return {parameters, WallRules::parse(rule_base("obstacle_following")).value(), {}};
}

// Readings, leftmost first. The walls are at the distance that the follower keeps.
constexpr std::initializer_list<double> kWallOnLeft = {0.32, 0.5, 0.8, 1, 1, 1, 1};
constexpr std::initializer_list<double> kWallOnRight = {1, 1, 1, 1, 0.8, 0.5, 0.32};
constexpr std::initializer_list<double> kFree = {1, 1, 1, 1, 1, 1, 1};

/// The robot stands at the origin and heads along x.
Scene scene(std::initializer_list<double> readings, double target_x_m, double target_y_m) {
  return Scene().at(0, 0, 0).sees(readings).target(target_x_m, target_y_m);
}

struct Answer {
  EscapeStatus status;
  domain::Guidance guidance;
};

Answer step(ObstacleFollowing& escape, const Scene& scene) {
  Answer answer{};
  answer.status = escape.step(scene.situation(), answer.guidance);
  return answer;
}

Answer begin(ObstacleFollowing& escape, const Scene& scene) {
  escape.begin(scene.situation(), {});
  return step(escape, scene);
}

/// Takes the ticks of turning about, and returns the angle turned and the answer after it.
std::pair<double, Answer> turn_about(ObstacleFollowing& escape, const Scene& scene) {
  double turned_rad = 0.0;
  Answer answer = begin(escape, scene);
  while (answer.guidance.why == "turn about") {
    turned_rad += answer.guidance.override_motion.turn_rad;
    answer = step(escape, scene);
  }
  return {turned_rad, answer};
}

TEST(CaseOne, LeavesTheFuzzyRulesInChargeWhileTheTargetIsOnTheWallsSide) {
  ObstacleFollowing escape = make();

  const Answer answer = begin(escape, scene(kWallOnLeft, 1, 3));

  EXPECT_EQ(answer.status, EscapeStatus::kActive);
  EXPECT_FALSE(answer.guidance.has_override);
  EXPECT_EQ(answer.guidance.why, "step 1");
}

TEST(CaseOne, FollowsTheWallOnTheLeftWhenTheTargetComesOnTheRightBehind) {
  ObstacleFollowing escape = make();
  begin(escape, scene(kWallOnLeft, -1, 3));

  const Answer answer = step(escape, scene(kWallOnLeft, -3, -1));

  EXPECT_TRUE(answer.guidance.has_override);
  EXPECT_EQ(answer.guidance.why, "wall on left");
}

TEST(CaseOne, DoesNotFollowWhenTheTargetChangesSidesAhead) {
  ObstacleFollowing escape = make();
  begin(escape, scene(kWallOnLeft, 3, 1));

  EXPECT_FALSE(step(escape, scene(kWallOnLeft, 3, -1)).guidance.has_override);
}

TEST(CaseOne, DoesNotFollowWhatIsOutOfView) {
  ObstacleFollowing escape = make();
  begin(escape, scene(kWallOnLeft, -1, 3));

  EXPECT_FALSE(step(escape, scene(kFree, -3, -1)).guidance.has_override);
}

TrapEvidence standing_still() {
  TrapEvidence evidence;
  evidence.stands_still = true;
  return evidence;
}

TEST(StandingStill, InStepOneIsFollowedByFollowing) {
  ObstacleFollowing escape = make();
  const Scene stands = scene(kWallOnLeft, 1, 3);
  begin(escape, stands);

  EXPECT_FALSE(escape.take_up(stands.situation(), {}));
  EXPECT_TRUE(escape.take_up(stands.situation(), standing_still()));
  const Answer answer = step(escape, stands);

  EXPECT_EQ(answer.status, EscapeStatus::kActive);
  EXPECT_EQ(answer.guidance.why, "wall on left");
}

TEST(StandingStill, WhileItFollowsIsAFailure) {
  ObstacleFollowing escape = make();
  const Scene stands = scene(kWallOnLeft, 1, 3);
  begin(escape, stands);
  escape.take_up(stands.situation(), standing_still());
  step(escape, stands);

  EXPECT_TRUE(escape.take_up(stands.situation(), standing_still()));
  const Answer answer = step(escape, stands);

  EXPECT_EQ(answer.status, EscapeStatus::kFailed);
  EXPECT_EQ(answer.guidance.why, "stands still");
  EXPECT_EQ(begin(escape, stands).status, EscapeStatus::kActive);  // a new trap begins anew
}

TEST(CaseTwo, IsTheMirrorImage) {
  ObstacleFollowing escape = make();

  const Answer first = begin(escape, scene(kWallOnRight, -1, -3));
  const Answer swapped = step(escape, scene(kWallOnRight, -3, 1));

  EXPECT_FALSE(first.guidance.has_override);
  EXPECT_EQ(swapped.guidance.why, "wall on right");
}

TEST(CaseTwo, TakesOverWhenBothChangeSidesInStepOne) {
  ObstacleFollowing escape = make();
  begin(escape, scene(kWallOnLeft, -1, 3));
  step(escape, scene(kWallOnRight, -1, -3));

  EXPECT_EQ(step(escape, scene(kWallOnRight, -3, 1)).guidance.why, "wall on right");
}

TEST(CaseThree, TurnsAboutTowardTheObstacleAndFollowsItOnTheOtherSide) {
  ObstacleFollowing escape = make();

  // The obstacle is nearest at 45 degrees on the right, the target is on the left.
  const auto [turned_rad, answer] = turn_about(escape, scene(kWallOnRight, 1, 3));

  // From 45 degrees on the right to 90 degrees on the left: 135 degrees to the right.
  EXPECT_NEAR(turned_rad, radians(-135.0), 1e-12);
  EXPECT_EQ(answer.guidance.why, "wall on left");
}

TEST(CaseFour, TurnsAboutTheOtherWay) {
  ObstacleFollowing escape = make();

  const auto [turned_rad, answer] = turn_about(escape, scene(kWallOnLeft, 1, -3));

  EXPECT_NEAR(turned_rad, radians(135.0), 1e-12);
  EXPECT_EQ(answer.guidance.why, "wall on right");
}

TEST(CaseThree, TurnsOnUntilTheTargetIsOnTheRight) {
  ObstacleFollowing escape = make();

  // 135 degrees would leave the target, 14 degrees on the left, on the left.
  const auto [turned_rad, answer] = turn_about(escape, scene(kWallOnRight, 4, 1));

  EXPECT_NEAR(turned_rad, radians(-171.0), radians(0.1));
  EXPECT_EQ(answer.guidance.why, "wall on left");
}

TEST(CaseFour, TurnsOnTheSpotInSmallTurns) {
  ObstacleFollowing escape = make();

  const Answer answer = begin(escape, scene(kWallOnLeft, 1, -3));

  EXPECT_EQ(answer.guidance.override_motion.turn_rad, radians(30.0));
  EXPECT_EQ(answer.guidance.override_motion.step_m, 0.0);
}

TEST(Cases, TakeAnObstacleStraightAheadToBeOnTheTargetsSide) {
  ObstacleFollowing escape = make();

  EXPECT_EQ(begin(escape, scene({1, 1, 0.5, 0.3, 0.5, 1, 1}, 1, -3)).guidance.why, "step 1");
}

TEST(StepOne, EndsInAClosedWall) {
  ObstacleFollowing escape = make();
  begin(escape, scene(kWallOnLeft, 1, 3));

  EXPECT_EQ(step(escape, scene(kWallOnLeft, 1, 3).travelled(5.9)).guidance.why, "step 1");
  EXPECT_EQ(step(escape, scene(kWallOnLeft, 1, 3).travelled(6.1)).guidance.why, "wall on left");
}

/// An escape that follows a wall on the left since the robot was 5 m from the target.
ObstacleFollowing following(LeavingRule leave = LeavingRule::kNearer) {
  ObstacleFollowing escape = make(leave);
  begin(escape, scene(kWallOnLeft, -1, 3));
  EXPECT_EQ(step(escape, scene(kWallOnLeft, -4, -3)).guidance.why, "wall on left");
  return escape;
}

TEST(LeavingNearer, AsksForMoreThanTheMargin) {
  ObstacleFollowing escape = following();

  // 0.2 of the range of 1 m: nearer than 4.8 m.
  EXPECT_EQ(step(escape, scene(kFree, 4.81, 0)).guidance.why, "wall on left");
  EXPECT_EQ(step(escape, scene(kFree, 4.79, 0)).guidance.why, "step 1");
}

TEST(LeavingNearer, AsksForAClearWay) {
  ObstacleFollowing escape = following();

  // Ahead is the target; the beams next to it count, those farther off do not.
  EXPECT_TRUE(step(escape, scene({1, 1, 0.79, 1, 1, 1, 1}, 4, 0)).guidance.has_override);
  EXPECT_TRUE(step(escape, scene({1, 1, 1, 0.79, 1, 1, 1}, 4, 0)).guidance.has_override);
  EXPECT_FALSE(step(escape, scene({1, 0.4, 1, 1, 1, 1, 1}, 4, 0)).guidance.has_override);
}

TEST(LeavingNearer, NeedsTheTargetInView) {
  ObstacleFollowing escape = following();

  EXPECT_TRUE(step(escape, scene(kFree, 0, 4)).guidance.has_override);
  EXPECT_TRUE(step(escape, scene(kFree, -4, 0)).guidance.has_override);
}

TEST(LeavingNearer, AsksForAClearWayOnlyAsFarAsTheTarget) {
  ObstacleFollowing escape = following();

  EXPECT_FALSE(step(escape, scene({1, 1, 1, 0.5, 1, 1, 1}, 0.45, 0)).guidance.has_override);
}

TEST(LeavingNearer, ComesEverNearer) {
  ObstacleFollowing escape = following();
  step(escape, scene(kFree, 4, 0));  // leaves at 4 m
  begin(escape, scene(kWallOnLeft, -1, 3));
  step(escape, scene(kWallOnLeft, -4, -3));  // follows again, from 5 m

  EXPECT_TRUE(step(escape, scene(kFree, 3.81, 0)).guidance.has_override);
  EXPECT_FALSE(step(escape, scene(kFree, 3.79, 0)).guidance.has_override);
}

TEST(LeavingNearer, EndsTheEscapeWhenTheWayHasBeenOpen) {
  ObstacleFollowing escape = following();
  step(escape, scene(kFree, 4, 0).travelled(3.0));

  EXPECT_EQ(step(escape, scene(kFree, 3, 0).travelled(4.9)).status, EscapeStatus::kActive);
  EXPECT_EQ(step(escape, scene(kFree, 2, 0).travelled(5.1)).status, EscapeStatus::kEnded);
}

TEST(LeavingNearer, FollowsAgainWhenTheTargetChangesSidesBehind) {
  ObstacleFollowing escape = following();
  step(escape, scene(kFree, 4, 0));
  step(escape, scene(kWallOnRight, -1, -3));

  EXPECT_EQ(step(escape, scene(kWallOnRight, -1, 3)).guidance.why, "wall on right");
}

TEST(LeavingByThePaper, TakesABreakWithTheTargetOnTheWallsSide) {
  ObstacleFollowing left = following(LeavingRule::kPaper);
  ObstacleFollowing right = following(LeavingRule::kPaper);

  // Farther away than where it began: that does not matter here.
  EXPECT_EQ(step(left, scene(kFree, -6, 6)).guidance.why, "step 1");
  EXPECT_EQ(step(right, scene(kFree, -6, -6)).guidance.why, "wall on left");
}

TEST(LeavingByThePaper, NeedsABreak) {
  ObstacleFollowing escape = following(LeavingRule::kPaper);

  EXPECT_EQ(step(escape, scene(kWallOnLeft, 1, 3)).guidance.why, "wall on left");
}

TEST(LeavingByThePaper, NeverEndsTheEscape) {
  ObstacleFollowing escape = following(LeavingRule::kPaper);
  step(escape, scene(kFree, -6, 6));

  EXPECT_EQ(step(escape, scene(kFree, -6, 6).travelled(100.0)).status, EscapeStatus::kActive);
}

// A wall, and other things all round: the way is clear nowhere.
constexpr std::initializer_list<double> kCrowdedLeft = {0.32, 0.5, 0.7, 0.7, 0.7, 0.7, 0.7};
constexpr std::initializer_list<double> kCrowdedRight = {0.7, 0.7, 0.7, 0.7, 0.7, 0.5, 0.32};

/// Follows a circle of 1 m round the origin with the wall on the inner side, until the answer is
/// another one than following on that side.
Answer go_round(ObstacleFollowing& escape, bool counter_clockwise, const core::Vec2& target,
                double& travel_m) {
  Answer answer{};
  const std::string why = counter_clockwise ? "wall on left" : "wall on right";
  for (int i = 0; i < 400; ++i) {
    travel_m += 0.05;
    const double angle_rad = (counter_clockwise ? 1.0 : -1.0) * travel_m;
    Scene at_wall;
    at_wall.at(std::cos(angle_rad), std::sin(angle_rad),
               core::degrees(angle_rad) + (counter_clockwise ? 90.0 : -90.0));
    at_wall.travelled(travel_m).target(target.x(), target.y());
    at_wall.sees(counter_clockwise ? kCrowdedLeft : kCrowdedRight);
    answer = step(escape, at_wall);
    if (answer.status != EscapeStatus::kActive || answer.guidance.why != why) return answer;
  }
  return answer;
}

/// Begins to follow with the wall on the left, 5 m from the target, which is out of reach.
ObstacleFollowing following_round() {
  ObstacleFollowing escape = make();
  begin(escape, scene(kWallOnLeft, -1, 3));
  step(escape, scene(kWallOnLeft, -4, -3));
  return escape;
}

TEST(ComingRound, FailsAfterACircuitOnEachSide) {
  ObstacleFollowing escape = following_round();
  double travel_m = 0.0;

  // The target is inside the obstacle.
  const Answer first = go_round(escape, true, {0.1, 0}, travel_m);
  Answer turning = first;
  while (turning.guidance.why == "turn about") {
    turning = step(escape, scene(kCrowdedRight, 0.9, 0).travelled(travel_m));
  }
  const Answer second = go_round(escape, false, {0.1, 0}, travel_m);

  EXPECT_EQ(first.status, EscapeStatus::kActive);
  EXPECT_EQ(first.guidance.why, "turn about");
  EXPECT_EQ(turning.guidance.why, "wall on right");
  EXPECT_EQ(second.status, EscapeStatus::kFailed);
  EXPECT_EQ(second.guidance.why, "a wall all round, on both sides");
}

TEST(ComingRound, FailsWithoutAPlaceToLeave) {
  ObstacleFollowing escape = following_round();
  double travel_m = 0.0;

  // The target is outside, and the way to it is never clear: the escape has no place to leave at.
  EXPECT_EQ(go_round(escape, true, {50, 0}, travel_m).status, EscapeStatus::kFailed);
}

TEST(ObstacleFollowing, FailsWithoutAWallToFollow) {
  ObstacleFollowing escape = following();

  EXPECT_EQ(step(escape, scene(kFree, -4, -3).travelled(3.9)).status, EscapeStatus::kActive);
  EXPECT_EQ(step(escape, scene(kFree, -4, -3).travelled(4.1)).status, EscapeStatus::kFailed);
}

TEST(ObstacleFollowing, GoesOnAsBeforeAfterSaveAndLoad) {
  ObstacleFollowing escape = following_round();
  double travel_m = 0.0;
  for (int i = 0; i < 20; ++i) travel_m += 0.05;
  core::StateWriter writer;
  escape.save(writer);

  ObstacleFollowing restored = make();
  core::StateReader reader(writer.bytes());
  restored.load(reader);
  double other_travel_m = travel_m;
  const Answer expected = go_round(escape, true, {0.1, 0}, travel_m);
  const Answer answer = go_round(restored, true, {0.1, 0}, other_travel_m);

  EXPECT_TRUE(reader.complete());
  EXPECT_EQ(answer.guidance.why, expected.guidance.why);
  EXPECT_EQ(other_travel_m, travel_m);
}

TEST(ObstacleFollowing, RefusesASensorThatLooksElsewhere) {
  domain::BehaviourSetup setup;
  setup.scan = {"bumper_eye", 3, radians(-10.0), radians(10.0), 0.0, 1.0};

  const auto made = ObstacleFollowing::create({}, setup);

  ASSERT_FALSE(made.ok());
  EXPECT_EQ(made.error().message,
            "obstacle_following needs a beam in each of seven sectors of 15 deg, from 45 deg to "
            "-45 deg; 'bumper_eye' has none in the one at 45 deg");
}

}  // namespace
}  // namespace clew::recover
