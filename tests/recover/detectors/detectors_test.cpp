// SPDX-License-Identifier: Apache-2.0
/// The detectors that need no landmark.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "recover/detectors/heading_reversal.hpp"
#include "recover/detectors/no_progress.hpp"
#include "recover/detectors/no_safe_region.hpp"
#include "recover/detectors/oscillation.hpp"
#include "recover/detectors/position_revisit.hpp"
#include "tests/recover/scene.hpp"

namespace clew::recover {
namespace {

/// Drives a detector along a path of straight stretches in steps, turning at once where they meet.
class Drive {
 public:
  explicit Drive(TrapDetector& detector) : detector_(detector) {}

  Drive& to(double x_m, double y_m, double step_m = 0.1) {
    const core::Vec2 goal(x_m, y_m);
    const core::Vec2 way = goal - pose_.position();
    const auto steps = static_cast<int>(std::lround(core::length(way) / step_m));
    pose_.heading_rad = core::atan2(way.y(), way.x());
    for (int i = 0; i < steps; ++i) {
      pose_.x_m += way.x() / steps;
      pose_.y_m += way.y() / steps;
      travel_m_ += core::length(way) / steps;
      look();
    }
    return *this;
  }
  Drive& turn(double by_deg) {
    pose_.heading_rad = core::wrap_angle_rad(pose_.heading_rad + core::radians(by_deg));
    look();
    return *this;
  }
  Drive& rest(int ticks) {
    for (int i = 0; i < ticks; ++i) look();
    return *this;
  }

  /// Odometry is less certain with every metre: variances of x and y each, and of the heading.
  Drive& drifts(double place_m2, double heading_rad2) {
    place_m2_ = place_m2;
    heading_rad2_ = heading_rad2;
    return *this;
  }

  std::vector<TrapEvidence> found;
  std::vector<std::uint64_t> found_at;

 private:
  void look() {
    const Scene scene = Scene()
                            .tick(tick_)
                            .at(pose_.x_m, pose_.y_m, core::degrees(pose_.heading_rad))
                            .travelled(travel_m_)
                            .uncertain(place_m2_ * travel_m_, heading_rad2_ * travel_m_);
    const auto evidence = detector_.observe(scene.situation());
    if (evidence) {
      found.push_back(*evidence);
      found_at.push_back(tick_);
    }
    ++tick_;
  }

  TrapDetector& detector_;
  core::Pose2 pose_;
  double travel_m_ = 0.0;
  double place_m2_ = 0.0;
  double heading_rad2_ = 0.0;
  std::uint64_t tick_ = 0;
};

/// Twice round a square of 2 m.
void go_round(Drive& drive) {
  for (int i = 0; i < 2; ++i) drive.to(2, 0).to(2, 2).to(0, 2).to(0, 0);
}

TEST(PositionRevisit, SaysTrapAtTheThirdPositionSeenBefore) {
  PositionRevisit detector({});
  Drive drive(detector);

  go_round(drive);

  // The first position is (0.1, 0), at tick 0; the square is 80 steps, so that the second visits
  // come at ticks 80, 81 and 82, each 8 m after the first ones.
  ASSERT_FALSE(drive.found.empty());
  EXPECT_EQ(drive.found_at[0], 82u);
  ASSERT_TRUE(drive.found[0].earlier.has_value());
  EXPECT_EQ(drive.found[0].earlier->tick, 2u);
  EXPECT_NEAR(drive.found[0].earlier->position_odom.x(), 0.3, 1e-9);
  EXPECT_NEAR(drive.found[0].earlier->travel_m, 8.0, 1e-9);
}

TEST(PositionRevisit, KnowsAPlaceByItsDirectionToo) {
  PositionRevisit detector({});
  Drive drive(detector);

  drive.to(3, 0).to(0, 0);       // there and back: other directions
  drive.to(1.5, -2).to(1.5, 2);  // across the path

  EXPECT_TRUE(drive.found.empty());
}

TEST(PositionRevisit, WidensWithThePathBetween) {
  PositionRevisitParameters parameters;
  parameters.place_full_m = 0.1;
  parameters.place_none_m = 0.2;
  parameters.place_drift_ratio = 0.02;
  PositionRevisit drifting(parameters);
  parameters.place_drift_ratio = 0.0;
  PositionRevisit exact(parameters);

  // The second time 0.25 m beside the first, after 10.25 m: by then 0.2 m wider.
  for (PositionRevisit* detector : {&drifting, &exact}) {
    Drive drive(*detector);
    drive.to(5, 0).to(5, 0.25, 0.125).to(0, 0.25).to(4, 0.25);

    EXPECT_EQ(drive.found.empty(), detector == &exact);
  }
}

TEST(PositionRevisit, WidensWithWhatOdometrysCovarianceHasGrownBy) {
  PositionRevisitParameters parameters;
  parameters.place_drift_ratio = 0.0;
  parameters.drift_sigmas = 2.0;
  PositionRevisit drifting(parameters);
  PositionRevisit certain(parameters);
  parameters.drift_sigmas = 0.0;
  PositionRevisit blind(parameters);

  // The second time 0.5 m beside the first, after 10.5 m: x and y have 0.0025 m^2 a metre each, so
  // two standard deviations are 2 sqrt(0.0525) = 0.46 m. Half of the membership is left at 0.25 m,
  // and so at 0.71 m with them.
  for (PositionRevisit* detector : {&drifting, &certain, &blind}) {
    Drive drive(*detector);
    if (detector != &certain) drive.drifts(0.0025, 0.0);
    drive.to(5, 0).to(5, 0.5, 0.125).to(0, 0.5).to(4, 0.5);
    EXPECT_EQ(drive.found.empty(), detector != &drifting);
  }
}

TEST(PositionRevisit, WidensDirectionsWithTheVarianceOfTheHeading) {
  PositionRevisitParameters parameters;
  parameters.direction_drift_radpm = 0.0;
  parameters.drift_sigmas = 2.0;
  PositionRevisit drifting(parameters);
  PositionRevisit certain(parameters);

  // The second way crosses the first at 45 degrees, where *same direction* is gone; two standard
  // deviations after some 11 m are 2 sqrt(0.11) = 0.66 rad.
  for (PositionRevisit* detector : {&drifting, &certain}) {
    Drive drive(*detector);
    if (detector == &drifting) drive.drifts(0.0, 0.01);
    drive.to(3, 0).to(3, -2).to(0, -2).to(0, -1.5).to(3, 1.5, 0.05);
    EXPECT_EQ(drive.found.empty(), detector == &certain);
  }
}

TEST(PositionRevisit, TellsAPlaceSeenWithAnotherDirectionApartAndCountsItWhereAsked) {
  PositionRevisitParameters parameters;
  PositionRevisit same(parameters);
  parameters.other_direction = true;
  PositionRevisit any(parameters);
  Drive not_found(same);
  Drive found(any);

  not_found.to(3, 0).to(0, 0);
  found.to(3, 0).to(0, 0);

  EXPECT_TRUE(not_found.found.empty());
  ASSERT_FALSE(found.found.empty());
  EXPECT_EQ(found.found[0].text, "3 positions in a row seen before, 3 with another direction");
  PositionRevisit fresh({});
  Drive around(fresh);
  go_round(around);
  ASSERT_FALSE(around.found.empty());
  EXPECT_EQ(around.found[0].text, "3 positions in a row seen before");
}

TEST(PositionRevisit, DoesNotKnowItsOwnTail) {
  PositionRevisit detector({});
  Drive drive(detector);

  drive.to(0.1, 0).rest(50).to(3, 0);

  EXPECT_TRUE(drive.found.empty());
}

TEST(PositionRevisit, StartsAfresh) {
  PositionRevisit detector({});
  Drive drive(detector);

  drive.to(2, 0).to(2, 2).to(0, 2).to(0, 0);
  detector.start_afresh();
  drive.to(2, 0);

  EXPECT_TRUE(drive.found.empty());
}

TEST(PositionRevisit, RefusesMembershipsThatDoNotFall) {
  PositionRevisitParameters place;
  place.place_full_m = 0.4;
  PositionRevisitParameters direction;
  direction.direction_full_rad = direction.direction_none_rad;
  PositionRevisitParameters grid;
  grid.grid_m = 0.3;

  EXPECT_EQ(PositionRevisit::create(place, {}).error().message,
            "position_revisit needs a place_none_m above its place_full_m");
  EXPECT_EQ(PositionRevisit::create(direction, {}).error().message,
            "position_revisit needs a direction_none_deg above its direction_full_deg");
  EXPECT_EQ(PositionRevisit::create(grid, {}).error().message,
            "position_revisit needs a grid_m of at least its place_none_m");
}

TEST(HeadingReversal, SaysTrapWhenTheRobotTurnsBackWithinTheWindow) {
  HeadingReversal detector({});
  Drive drive(detector);

  drive.to(2, 0).turn(90).turn(60).turn(15);

  // 150 degrees are too little, 165 are enough; the oldest tick of the window is 0.
  ASSERT_EQ(drive.found.size(), 1u);
  EXPECT_EQ(drive.found_at[0], 22u);
  EXPECT_EQ(drive.found[0].earlier->tick, 2u);
  EXPECT_EQ(drive.found[0].text, "turned 165 deg in 20 ticks");
}

TEST(HeadingReversal, LetsTheRobotTurnSlowly) {
  HeadingReversal detector({});
  Drive drive(detector);

  drive.to(2, 0);
  for (int i = 0; i < 90; ++i) drive.turn(7);  // 140 degrees in 20 ticks

  EXPECT_TRUE(drive.found.empty());
}

TEST(HeadingReversal, DoesNotMistakeAWiggleForATurn) {
  HeadingReversal detector({});
  Drive drive(detector);

  for (int i = 0; i < 20; ++i) drive.turn(100).turn(-100);

  EXPECT_TRUE(drive.found.empty());
}

TEST(NoProgress, SaysTrapWhenTheRobotStaysForTheAllowedTime) {
  NoProgressParameters parameters;
  parameters.radius_m = 0.45;
  NoProgress detector(parameters, 0.5);
  Drive drive(detector);

  drive.to(2, 0).rest(30);

  // The last progress is at 0.1 + 3 * 0.5 = 1.6 m, tick 15; 10 s are 20 ticks, the next one tells.
  ASSERT_EQ(drive.found.size(), 1u);
  EXPECT_EQ(drive.found_at[0], 36u);
  EXPECT_EQ(drive.found[0].earlier->tick, 15u);
  EXPECT_NEAR(drive.found[0].earlier->position_odom.x(), 1.6, 1e-9);
}

TEST(NoProgress, TakesGoingRoundForProgress) {
  NoProgress detector({}, 0.5);
  Drive drive(detector);

  go_round(drive);

  EXPECT_TRUE(drive.found.empty());
}

TEST(NoProgress, OfTheTargetAsksForComingNearer) {
  NoProgressParameters parameters;
  parameters.of = Progress::kTarget;
  NoProgress detector(parameters, 0.5);
  Drive drive(detector);

  go_round(drive);  // the target is at (10, 0): nearest on the side x = 2, from tick 19 on

  ASSERT_FALSE(drive.found.empty());
  EXPECT_LT(drive.found_at[0], 60u);
}

TEST(Oscillation, SaysTrapAtTheSecondTurnBackThatWasMadeBefore) {
  Oscillation detector({});
  Drive drive(detector);

  // Turns back at 4, 0, and at 4 and 0 again.
  drive.to(4, 0).to(0, 0).to(4, 0).to(0, 0);
  const bool too_early = !drive.found.empty();
  drive.to(4, 0);

  EXPECT_FALSE(too_early);
  ASSERT_EQ(drive.found.size(), 1u);
  EXPECT_NEAR(drive.found[0].earlier->position_odom.x(), 0.1, 1e-9);
  EXPECT_NEAR(drive.found[0].earlier->travel_m, 8.0, 1e-9);
}

TEST(Oscillation, IsNotTurningBackElsewhere) {
  Oscillation detector({});
  Drive drive(detector);

  for (int i = 0; i < 5; ++i) drive.to(4, 2.0 * i).to(0, 2.0 * i + 1);

  EXPECT_TRUE(drive.found.empty());
}

TEST(Oscillation, IsNotGoingRound) {
  Oscillation detector({});
  Drive drive(detector);

  for (int i = 0; i < 3; ++i) drive.to(4, 0).to(4, 4).to(0, 4).to(0, 0);

  EXPECT_TRUE(drive.found.empty());
}

class NoSafeRegionTest : public ::testing::Test {
 protected:
  /// How often it says trap in `ticks` ticks of the same scene.
  int traps(const Scene& scene, int ticks = 10) {
    int count = 0;
    for (int i = 0; i < ticks; ++i) count += detector_.observe(scene.situation()).has_value();
    return count;
  }

  static domain::BehaviourSetup setup(std::size_t beams, double step_deg, double width_deg) {
    domain::BehaviourSetup setup;
    setup.scan = {"eyes", beams, 0.0, core::radians(step_deg), core::radians(width_deg), 1.0};
    return setup;
  }

  NoSafeRegion detector_{{}, 0.15};
};

// With a range of 1 m a gap is 0.6 m deep.
TEST_F(NoSafeRegionTest, SaysTrapOnceWhereAllIsClosed) {
  const Scene closed = Scene().sees({0.3, 0.3, 0.3, 0.3, 0.3, 0.3, 0.3});

  EXPECT_EQ(traps(closed, 2), 0);
  EXPECT_EQ(traps(closed, 8), 1);
  EXPECT_EQ(traps(Scene()), 0);
  EXPECT_EQ(traps(closed), 1);
}

TEST_F(NoSafeRegionTest, SeesTheGap) {
  // Two cones are enough: beside each, asin(0.17 / 0.45) = 22 degrees and half a cone are closed.
  EXPECT_EQ(traps(Scene().sees({1, 1, 1, 1, 0.3, 0.3, 0.3})), 0);
  EXPECT_EQ(traps(Scene().sees({1, 0.3, 0.3, 0.3, 0.3, 0.3, 0.3})), 1);
}

TEST_F(NoSafeRegionTest, TakesATargetThatIsNearerForAGap) {
  const Scene closed = Scene().sees({0.3, 0.3, 0.3, 0.3, 0.3, 0.3, 0.3});

  // Free for 0.45 - 0.17 m.
  EXPECT_EQ(traps(Scene(closed).target(0.27, 0)), 0);
  EXPECT_EQ(traps(Scene(closed).target(0.29, 0)), 1);
}

TEST_F(NoSafeRegionTest, LooksTowardTheTargetInForce) {
  const Scene closed = Scene().sees({0.3, 0.3, 0.3, 0.3, 0.3, 0.3, 0.3});

  // Of the half circle around a target that is abeam, the cones see less than half.
  EXPECT_EQ(traps(Scene(closed).pursues(0, 5)), 0);
  EXPECT_EQ(traps(Scene(closed).pursues(5, 0)), 1);
}

TEST_F(NoSafeRegionTest, RefusesEyesThatSeeTooLittle) {
  EXPECT_EQ(NoSafeRegion::create({}, setup(4, 90, 0)).error().message,
            "no_safe_region needs at most 15 degrees unseen between beams, a field of view of 90 "
            "degrees (seen_ratio of twice sector_deg); 'eyes' gives 4 beams of 0 degrees, 90 "
            "degrees apart from 0 on");
  EXPECT_FALSE(NoSafeRegion::create({}, setup(5, 15, 15)).ok());  // 75 degrees
  EXPECT_TRUE(NoSafeRegion::create({}, setup(7, -15, 15)).ok());
}

}  // namespace
}  // namespace clew::recover
