// SPDX-License-Identifier: Apache-2.0
#include "recover/detectors/no_connecting_path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/angle.hpp"

namespace clew::recover {
namespace {

constexpr double kRadius_m = 0.15;
constexpr double kWall_m = 1.0;  // x of the wall
constexpr double kEndless_m = std::numeric_limits<double>::infinity();

/// A robot that looks along x at a wall across it, with a laser of 2 m over the half circle ahead.
class NoConnectingPathTest : public ::testing::Test {
 protected:
  NoConnectingPathTest() {
    scan_.bearing_first_rad = -0.5 * core::kPi;
    scan_.bearing_step_rad = core::radians(1.0);
    scan_.range_max_m = 2.0;
    scan_.ranges_m.assign(181, scan_.range_max_m);
  }

  /// How often it says trap on the way to and fro between x = 0 and x = -0.4 m, by 0.2 m a tick.
  int traps(int ticks) {
    int count = 0;
    for (int i = 0; i < ticks; ++i, ++tick_) {
      const int quarter = static_cast<int>(tick_ % 4);
      odometry_.pose_odom_robot = {-0.2 * (quarter < 3 ? quarter : 1), 0.0, 0.0};
      look();
      const Situation situation{tick_, odometry_, scan_, nullptr, target_, pursued_, 0.2};
      count += detector_.observe(situation).has_value();
    }
    return count;
  }

  static domain::BehaviourSetup setup(std::size_t beams, double step_deg) {
    domain::BehaviourSetup setup;
    setup.scan = {"eyes", beams, 0.0, core::radians(step_deg), 0.0, 2.0};
    return setup;
  }

  double wall_to_y_m_ = kEndless_m;  ///< from far on the right
  core::Vec2 target_{3.0, 0.0};
  core::Vec2 pursued_ = target_;
  NoConnectingPath detector_{{}, kRadius_m};

 private:
  void look() {
    const core::Pose2& pose = odometry_.pose_odom_robot;
    for (std::size_t i = 0; i < scan_.ranges_m.size(); ++i) {
      const core::Vec2 beam = core::direction(scan_.bearing_rad(i));
      const double distance_m = (kWall_m - pose.x_m) / beam.x();
      const bool hit = beam.x() > 1e-3 && distance_m * beam.y() <= wall_to_y_m_;
      scan_.ranges_m[i] =
          hit ? std::min(distance_m - kRadius_m, scan_.range_max_m) : scan_.range_max_m;
    }
  }

  std::uint64_t tick_ = 0;
  domain::Odometry odometry_;
  domain::Scan scan_;
};

// The first leg, along the wall, is 2 m long, and over after twice as much: 20 ticks of 0.2 m after
// the first one. The next one takes as long, and nothing has changed by then.
TEST_F(NoConnectingPathTest, SaysTrapOnceAtTheEndOfALegBeforeAnEndlessWall) {
  EXPECT_EQ(traps(20), 0);
  EXPECT_EQ(traps(1), 1);
  EXPECT_EQ(traps(60), 0);
}

// Past the wall's end, at 45 degrees, a way of 2 m leads to (1.4, 1.4), and from there straight on.
TEST_F(NoConnectingPathTest, SeesThePathPastTheEndOfAWall) {
  wall_to_y_m_ = 0.5;

  EXPECT_EQ(traps(60), 0);
}

TEST_F(NoConnectingPathTest, IsOnNoLegWhereTheStraightLineIsFree) {
  wall_to_y_m_ = -0.5;
  EXPECT_EQ(traps(60), 0);

  wall_to_y_m_ = kEndless_m;

  // A wall that comes up across the line is judged at once.
  EXPECT_EQ(traps(1), 1);
}

TEST_F(NoConnectingPathTest, LooksForPathsToTheTargetInForce) {
  pursued_ = {-3.0, 0.0};
  EXPECT_EQ(traps(60), 0);

  // Another target is given a leg before it is judged.
  pursued_ = target_;
  EXPECT_EQ(traps(20), 0);
  EXPECT_EQ(traps(1), 1);
}

TEST_F(NoConnectingPathTest, GivesANewLegWhenItStartsAfresh) {
  EXPECT_EQ(traps(15), 0);

  detector_.start_afresh();

  EXPECT_EQ(traps(20), 0);
  EXPECT_EQ(traps(1), 1);
}

TEST_F(NoConnectingPathTest, RefusesEyesThatSeeTooLittle) {
  EXPECT_FALSE(NoConnectingPath::create({}, setup(12, 30)).ok());  // 30 degrees between beams
  const auto narrow = NoConnectingPath::create({}, setup(5, 15));  // 75 degrees

  ASSERT_FALSE(narrow.ok());
  EXPECT_EQ(narrow.error().message.find("no_connecting_path needs 2 beams or more, at most 15 "
                                        "degrees unseen between beams, a field of view of 90 "
                                        "degrees; 'eyes' gives 5 beams"),
            0u);
  EXPECT_TRUE(NoConnectingPath::create({}, setup(7, 15)).ok());
}

}  // namespace
}  // namespace clew::recover
