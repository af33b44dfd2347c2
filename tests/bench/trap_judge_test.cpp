// SPDX-License-Identifier: Apache-2.0
#include "bench/trap_judge.hpp"

#include <gtest/gtest.h>

#include "world/world.hpp"

namespace clew::bench {
namespace {

constexpr double kRadius_m = 0.15;

/// A U open downward, its back at y = 6, the target at (5, 8) behind it: the trap's minimum is
/// 2.15 m from the target, and its region ends 5.5 m from it.
const world::World& u_world() {
  static const world::World world = *world::World::parse(
      "format: clew-world/1\nname: u\nbounds: [0, 0, 10, 10]\n"
      "walls: [[3, 3, 3, 6], [3, 6, 7, 6], [7, 6, 7, 3]]\n"
      "start: [5, 1, 1.57]\ntarget: [5, 8]\ntarget_radius: 0.2\n",
      "u.yaml");
  return world;
}

class TrapJudgeInAU : public testing::Test {
 protected:
  /// Goes straight to a place in one tick of 1 s.
  void go_to(double x_m, double y_m) {
    travel_m_ += core::length(core::Vec2(x_m, y_m) - position_);
    position_ = {x_m, y_m};
    domain::State state;
    state.stamp.sim_time_s = ++time_s_;
    state.pose_world_robot = {x_m, y_m, 0.0};
    state.path_length_m = travel_m_;
    judge_.add(state);
  }
  void say_trap(const std::string& rule, bool shadow = false) {
    domain::Event event;
    domain::EventEntry entry;
    entry.kind = domain::EventKind::kTrap;
    entry.rule = rule;
    entry.shadow = shadow;
    event.entries.push_back(entry);
    judge_.add(event);
  }
  const DetectorScore& score(std::size_t index = 0) const { return judge_.scores()[index]; }

  world_analysis::ClearanceGrid grid_{u_world(), 0.0};
  world_analysis::TrapMap map_{grid_, kRadius_m, 0.3};
  TrapJudge judge_{&map_, kRadius_m, {{"revisit", false, 0, 0, 0, {}, {}}}};
  core::Vec2 position_{5.0, 1.0};
  double travel_m_ = 0.0;
  double time_s_ = 0.0;
};

TEST_F(TrapJudgeInAU, AnAlarmBeforeTheTrapIsFalse) {
  go_to(5.0, 1.5);
  say_trap("revisit");

  EXPECT_EQ(score().alarms, 1u);
  EXPECT_EQ(score().false_alarms, 1u);
  EXPECT_EQ(judge_.captures(), 0u);
}

TEST_F(TrapJudgeInAU, AnAlarmInTheTrapIsTrueAndItsDelayCountsFromTheEntry) {
  go_to(5.0, 2.0);  // t = 1 s
  go_to(5.0, 3.0);  // t = 2 s, 2 m: within 5.5 m
  go_to(5.0, 5.0);  // t = 3 s, 4 m
  say_trap("revisit");
  go_to(5.0, 4.0);
  say_trap("revisit");

  EXPECT_EQ(judge_.captures(), 1u);
  EXPECT_EQ(score().alarms, 2u);
  EXPECT_EQ(score().false_alarms, 0u);
  EXPECT_EQ(score().noticed, 1u);
  EXPECT_EQ(score().delays_s, std::vector<double>{1.0});
  EXPECT_EQ(score().delays_m, std::vector<double>{2.0});
}

TEST_F(TrapJudgeInAU, TheTrapHoldsUntilTheRobotIsNearerToTheTargetThanItsMinimum) {
  go_to(5.0, 5.0);
  go_to(5.0, 2.0);  // out of the region, but a limit cycle leads here, too
  EXPECT_TRUE(judge_.is_held());
  go_to(2.0, 2.0);
  go_to(2.0, 7.0);  // 3.2 m from the target
  say_trap("revisit");
  EXPECT_TRUE(judge_.is_held());
  EXPECT_EQ(score().false_alarms, 0u);

  go_to(4.0, 7.0);  // 1.4 m

  EXPECT_FALSE(judge_.is_held());
  EXPECT_EQ(judge_.captures(), 1u);
}

TEST_F(TrapJudgeInAU, ComingBackIsAnotherCapture) {
  go_to(5.0, 5.0);
  go_to(4.0, 7.0);
  go_to(5.0, 5.0);

  EXPECT_EQ(judge_.captures(), 2u);
  EXPECT_EQ(score().noticed, 0u);
}

TEST_F(TrapJudgeInAU, AnAlarmInACircleIsTrueWithoutATrap) {
  go_to(1.0, 1.0);
  go_to(2.0, 1.0);
  go_to(1.1, 1.1);  // 1.9 m later within the robot's width of where it was
  say_trap("revisit");

  EXPECT_EQ(judge_.captures(), 0u);
  EXPECT_EQ(score().false_alarms, 0u);
}

TEST_F(TrapJudgeInAU, ShadowsAndUnknownRulesHaveScoresOfTheirOwn) {
  go_to(5.0, 5.0);
  say_trap("revisit", true);
  say_trap("oscillation", true);

  ASSERT_EQ(judge_.scores().size(), 3u);
  EXPECT_EQ(score(0).alarms, 0u);
  EXPECT_EQ(score(1).rule, "revisit");
  EXPECT_TRUE(score(1).shadow);
  EXPECT_EQ(score(1).noticed, 1u);
  EXPECT_EQ(score(2).noticed, 1u);
}

TEST(TrapJudge, WithoutATruthAlarmsAreOnlyCounted) {
  TrapJudge judge(nullptr, kRadius_m, {{"revisit", false, 0, 0, 0, {}, {}}});
  domain::Event event;
  domain::EventEntry entry;
  entry.kind = domain::EventKind::kTrap;
  entry.rule = "revisit";
  event.entries.push_back(entry);

  judge.add(domain::State());
  judge.add(event);

  EXPECT_FALSE(judge.has_truth());
  EXPECT_EQ(judge.scores()[0].alarms, 1u);
  EXPECT_EQ(judge.scores()[0].false_alarms, 0u);
}

}  // namespace
}  // namespace clew::bench
