// SPDX-License-Identifier: Apache-2.0
#include "recover/detectors/surrounded.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <utility>
#include <vector>

#include "map/local_map.hpp"

namespace clew::recover {
namespace {

constexpr double kRadius_m = 0.14;

domain::BehaviourSetup setup_of(double tick_s) {
  domain::BehaviourSetup setup;
  setup.tick_s = tick_s;
  setup.robot.radius_m = kRadius_m;
  setup.limits.speed_mps = 0.6;
  setup.limits.turn_rate_radps = 0.785;
  return setup;
}

struct Wall {
  core::Vec2 from;
  core::Vec2 to;
};

/// Three walls of a U that opens downward, 2.6 m wide; the end wall lies at y = 1.
const std::vector<Wall> kDeepU = {
    {{-1.3, -2.2}, {-1.3, 1.0}}, {{-1.3, 1.0}, {1.3, 1.0}}, {{1.3, 1.0}, {1.3, -2.2}}};

/// A robot with a range of 2 m that has seen some walls.
class SurroundedTest : public ::testing::Test {
 protected:
  void see(const std::vector<Wall>& walls) {
    map::SeenMap seen(0.025, 4096);
    for (const Wall& wall : walls) {
      const double length_m = core::length(wall.to - wall.from);
      for (double along_m = 0.0; along_m <= length_m; along_m += 0.02) {
        seen.mark_hit(wall.from + along_m / length_m * (wall.to - wall.from));
      }
    }
    local_map_.restore(seen.state());
  }

  /// How often it says trap in ticks in which the robot steps from where it is.
  int traps(int ticks, double step_m = 0.0) {
    int count = 0;
    for (int i = 0; i < ticks; ++i) {
      count += detector_.observe(situation()).has_value();
      pose().x_m += step_m * core::direction(pose().heading_rad).x();
      pose().y_m += step_m * core::direction(pose().heading_rad).y();
    }
    return count;
  }

  core::Pose2& pose() { return odometry_.pose_odom_robot; }
  Situation situation() {
    scan_.range_max_m = 2.0;
    return {tick_++, odometry_, scan_, nullptr, target_, pursued_, 0.2, &local_map_, nullptr};
  }

  core::Vec2 target_{0.0, 3.0};
  core::Vec2 pursued_ = target_;
  Surrounded detector_{{}, setup_of(0.1)};

 private:
  std::uint64_t tick_ = 0;
  domain::Odometry odometry_;
  domain::Scan scan_;
  map::LocalMap local_map_{{}, kRadius_m};
};

TEST_F(SurroundedTest, SaysTrapOnceAfterTenTicksInADeepU) {
  see(kDeepU);

  EXPECT_EQ(traps(9), 0);
  EXPECT_EQ(traps(1), 1);
  EXPECT_EQ(traps(100), 0);
}

TEST_F(SurroundedTest, SaysItAgainAfterMuchTravel) {
  see(kDeepU);
  EXPECT_EQ(traps(10), 1);
  pose().heading_rad = 0.5 * core::kPi;

  // To and fro by 0.05 m a tick: 5 m are 100 of them.
  const auto to_and_fro = [&](int ticks) {
    int count = 0;
    for (int i = 0; i < ticks; ++i) count += traps(1, i % 2 == 0 ? 0.05 : -0.05);
    return count;
  };
  EXPECT_EQ(to_and_fro(98), 0);
  EXPECT_EQ(to_and_fro(20), 1);
}

TEST_F(SurroundedTest, AWayAroundTheEndOfAWallConnects) {
  // As the deep U, but the end wall ends 0.5 m before the right one.
  see({{{-1.3, -2.2}, {-1.3, 1.0}}, {{-1.3, 1.0}, {0.8, 1.0}}, {{1.3, 1.0}, {1.3, -2.2}}});
  EXPECT_EQ(traps(50), 0);

  // 0.25 m are no way for a body of 0.28 m.
  see({{{-1.3, -2.2}, {-1.3, 1.0}}, {{-1.3, 1.0}, {1.05, 1.0}}, {{1.3, 1.0}, {1.3, -2.2}}});
  EXPECT_EQ(traps(50), 1);
}

TEST_F(SurroundedTest, WhatLiesBeyondItsReachIsFree) {
  see({{{-1.9, -2.2}, {-1.9, 1.9}}, {{-1.9, 2.3}, {1.9, 2.3}}, {{1.9, 1.9}, {1.9, -2.2}}});

  EXPECT_EQ(traps(50), 0);
}

TEST_F(SurroundedTest, ABlockInTheWayIsNoTrap) {
  see({{{-0.4, 1.0}, {0.4, 1.0}}, {{-0.4, 1.0}, {-0.4, 1.5}}, {{0.4, 1.0}, {0.4, 1.5}}});

  EXPECT_EQ(traps(50), 0);
}

TEST_F(SurroundedTest, TowardAVirtualTargetAWayThatLeadsOnIsEnough) {
  see(kDeepU);
  EXPECT_EQ(traps(10), 1);
  pursued_ = {-1.9, 0.0};  // beyond the left wall

  // Down the U its mouth lies ahead: no path connects, and yet it gets on.
  pose().heading_rad = -0.5 * core::kPi;
  EXPECT_EQ(traps(60, 0.01), 0);
}

TEST_F(SurroundedTest, AVirtualTargetIsJudgedOnceTheRobotHasMovedTowardIt) {
  see({{{-1.0, -1.0}, {-1.0, 1.0}},
       {{-1.0, 1.0}, {1.0, 1.0}},
       {{1.0, 1.0}, {1.0, -1.0}},
       {{1.0, -1.0}, {-1.0, -1.0}}});
  EXPECT_EQ(traps(10), 1);
  pursued_ = {-1.9, 0.0};
  pose() = {0.6, 0.0, 0.5 * core::kPi};

  EXPECT_EQ(traps(20), 0);  // it has not moved
  pose().heading_rad = core::kPi;
  int count = 0;
  for (int i = 0; i < 110; ++i) count += traps(1, i % 2 == 0 ? 0.05 : -0.05);
  EXPECT_EQ(count, 1);  // after 5 m, as nothing has connected since it came in force
}

TEST_F(SurroundedTest, ARobotThatStandsStillIsInATrapThoughNothingIsInTheWay) {
  EXPECT_EQ(traps(149), 0);
  EXPECT_EQ(traps(1), 1);
  EXPECT_EQ(traps(100), 0);
  EXPECT_EQ(traps(200, 0.01), 0);
}

TEST_F(SurroundedTest, TellsATrapForEachNewTargetOfTheMission) {
  see(kDeepU);
  EXPECT_EQ(traps(10), 1);

  detector_.start_afresh();
  target_ = pursued_ = {0.5, 3.0};
  EXPECT_EQ(traps(9), 0);
  EXPECT_EQ(traps(1), 1);

  // A plan's next subgoal is none: nothing says so.
  target_ = pursued_ = {0.0, 3.0};
  EXPECT_EQ(traps(50), 0);
}

TEST_F(SurroundedTest, TellsATrapOnceThoughAnEscapeFromItHasEnded) {
  see(kDeepU);
  EXPECT_EQ(traps(10), 1);
  pursued_ = {-1.9, 0.0};
  EXPECT_EQ(traps(5), 0);

  detector_.start_afresh();
  pursued_ = target_;
  EXPECT_EQ(traps(50), 0);
}

TEST_F(SurroundedTest, CountsStandingStillAnewWhereItStartsAfresh) {
  EXPECT_EQ(traps(100), 0);
  detector_.start_afresh();
  EXPECT_EQ(traps(149), 0);
  EXPECT_EQ(traps(1), 1);
}

TEST_F(SurroundedTest, IsAtATargetWithinItsRadius) {
  // The end wall lies at y = 1, and the body fits up to 0.16 m before it: 0.14 m short of this.
  target_ = pursued_ = {0.0, 0.98};
  std::vector<Wall> walls = kDeepU;
  walls.push_back({{-1.3, -1.0}, {1.3, -1.0}});
  see(walls);
  EXPECT_EQ(traps(50), 0);  // 0.2 m are near enough

  detector_.start_afresh();
  target_ = pursued_ = {0.0, 1.1};
  EXPECT_EQ(traps(50), 1);
}

TEST_F(SurroundedTest, StandsStillForSecondsHoweverLongATickIs) {
  detector_ = Surrounded({}, setup_of(0.01));
  EXPECT_EQ(traps(1499), 0);
  EXPECT_EQ(traps(1), 1);

  // Half as long again as half a turn and 0.1 m take, which is 6.25 s.
  SurroundedParameters impatient;
  impatient.still_s = 0.5;
  detector_ = Surrounded(impatient, setup_of(0.1));
  EXPECT_EQ(traps(62), 0);
  EXPECT_EQ(traps(1), 1);
}

TEST_F(SurroundedTest, RefusesCountsThatNoRunHas) {
  for (const std::int64_t count : {std::int64_t{-1}, std::int64_t{INT64_MAX}}) {
    Surrounded::State still;
    still.still = count;
    Surrounded::State surrounded;
    surrounded.in_a_row = count;
    for (const Surrounded::State& state : {still, surrounded}) {
      core::StateWriter writer;
      writer(state);
      core::StateReader reader(writer.bytes());
      detector_.load(reader);

      EXPECT_FALSE(reader.ok()) << count;
      EXPECT_EQ(traps(1), 0);
    }
  }
}

TEST_F(SurroundedTest, GoesOnFromWhatItSaved) {
  see(kDeepU);
  EXPECT_EQ(traps(7), 0);
  core::StateWriter writer;
  detector_.save(writer);
  Surrounded other({}, setup_of(0.1));
  core::StateReader reader(writer.bytes());
  other.load(reader);

  ASSERT_TRUE(reader.ok());
  EXPECT_FALSE(other.observe(situation()).has_value());
  EXPECT_FALSE(other.observe(situation()).has_value());
  EXPECT_TRUE(other.observe(situation()).has_value());
}

TEST(Surrounded, RefusesAFieldThatIsTooNarrow) {
  domain::BehaviourSetup setup;
  setup.scan = {"eyes", 31, 0.0, core::radians(1.0), 0.0, 2.0};

  EXPECT_FALSE(Surrounded::create({}, setup).ok());
}

}  // namespace
}  // namespace clew::recover
