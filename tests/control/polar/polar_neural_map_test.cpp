// SPDX-License-Identifier: Apache-2.0
#include "control/polar/polar_neural_map.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/angle.hpp"

namespace clew::control {
namespace {

using core::radians;

constexpr double kRange_m = 2.54;

/// A robot with 16 sonars around it.
domain::BehaviourSetup setup() {
  domain::BehaviourSetup setup;
  setup.tick_s = 0.1;
  setup.scan = {"sonar_ring", 16, core::kPi, radians(-22.5), radians(15.0), kRange_m};
  return setup;
}

domain::Scan free_scan() {
  domain::Scan scan;
  scan.bearing_first_rad = core::kPi;
  scan.bearing_step_rad = radians(-22.5);
  scan.beam_width_rad = radians(15.0);
  scan.range_max_m = kRange_m;
  scan.ranges_m.assign(16, kRange_m);
  return scan;
}

constexpr std::size_t kAhead = 8;

/// Returns over the front, as before a wall across the way.
domain::Scan wall_scan(double distance_m) {
  domain::Scan scan = free_scan();
  for (std::size_t i = kAhead - 2; i <= kAhead + 2; ++i) {
    scan.ranges_m[i] = distance_m / core::cos(scan.bearing_rad(i));
  }
  return scan;
}

domain::Odometry odometry_at(double time_s, const core::Pose2& pose, double speed_mps = 0.0) {
  domain::Odometry odometry;
  odometry.stamp.sim_time_s = time_s;
  odometry.pose_odom_robot = pose;
  odometry.speed_mps = speed_mps;
  return odometry;
}

TEST(PolarNeuralMap, SpeedsUpTowardATargetThatNothingHides) {
  PolarNeuralMap controller({}, setup());

  const domain::Motion motion = controller.step(odometry_at(0.0, {}, 0.3), free_scan(), {6.0, 0.0});

  EXPECT_EQ(motion.kind, domain::CommandKind::kVelocities);
  EXPECT_NEAR(motion.speed_mps, 0.35, 1e-12);  // 0.5 m/s^2 over 0.1 s
  EXPECT_NEAR(motion.turn_rate_radps, 0.0, 1e-12);
}

TEST(PolarNeuralMap, TurnsTowardATargetBesideIt) {
  PolarNeuralMap left({}, setup());
  PolarNeuralMap right({}, setup());

  EXPECT_GT(left.step(odometry_at(0.0, {}), free_scan(), {0.0, 6.0}).turn_rate_radps, 0.1);
  EXPECT_LT(right.step(odometry_at(0.0, {}), free_scan(), {0.0, -6.0}).turn_rate_radps, -0.1);
}

TEST(PolarNeuralMap, TurnsAwayBeforeAWall) {
  PolarNeuralMap controller({}, setup());

  const domain::Motion motion =
      controller.step(odometry_at(0.0, {}, 0.4), wall_scan(0.6), {6.0, 0.1});

  EXPECT_GT(std::fabs(motion.turn_rate_radps), 0.1);
}

TEST(PolarNeuralMap, RemembersWhatItDoesNotSeeAnyMore) {
  PolarNeuralMap remembering({}, setup());
  PolarNeuralMap fresh({}, setup());
  remembering.step(odometry_at(0.0, {}), wall_scan(0.6), {6.0, 0.1});

  const domain::Motion with_memory =
      remembering.step(odometry_at(0.1, {}), free_scan(), {6.0, 0.0});
  const domain::Motion without = fresh.step(odometry_at(0.1, {}), free_scan(), {6.0, 0.0});

  EXPECT_GT(std::fabs(with_memory.turn_rate_radps), 0.1);
  EXPECT_EQ(without.turn_rate_radps, 0.0);
}

TEST(PolarNeuralMap, ForgetsAfterItsTime) {
  PolarNeuralMapParameters parameters;
  parameters.memory_s = 0.3;
  PolarNeuralMap controller(parameters, setup());
  controller.step(odometry_at(0.0, {}), wall_scan(0.6), {6.0, 0.1});

  // Three scans of 0.1 s, the present one included.
  controller.step(odometry_at(0.1, {}), free_scan(), {6.0, 0.0});
  const double second =
      controller.step(odometry_at(0.2, {}), free_scan(), {6.0, 0.0}).turn_rate_radps;
  const double third =
      controller.step(odometry_at(0.3, {}), free_scan(), {6.0, 0.0}).turn_rate_radps;

  EXPECT_GT(std::fabs(second), 0.1);
  EXPECT_EQ(third, 0.0);
}

TEST(PolarNeuralMap, ForgetsWhileOthersSteer) {
  PolarNeuralMap controller({}, setup());
  controller.step(odometry_at(0.0, {}), wall_scan(0.6), {6.0, 0.1});

  const domain::Motion later = controller.step(odometry_at(5.0, {}), free_scan(), {6.0, 0.0});

  EXPECT_EQ(later.turn_rate_radps, 0.0);
}

TEST(PolarNeuralMap, TurnsOnTheSpotWhereNoWayShows) {
  PolarNeuralMap controller({}, setup());
  domain::Scan shut_in = free_scan();
  shut_in.ranges_m.assign(16, 0.1);

  const domain::Motion motion = controller.step(odometry_at(0.0, {}), shut_in, {0.0, -6.0});

  EXPECT_EQ(motion.speed_mps, 0.0);
  EXPECT_LT(motion.turn_rate_radps, -0.1);  // the target is on the right
}

TEST(PolarNeuralMap, GoesOnAsBeforeAfterSaveAndLoad) {
  PolarNeuralMap first({}, setup());
  first.step(odometry_at(0.0, {}), wall_scan(0.6), {6.0, 0.1});
  core::StateWriter writer;
  first.save(writer);

  PolarNeuralMap restored({}, setup());
  core::StateReader reader(writer.bytes());
  restored.load(reader);

  EXPECT_TRUE(reader.complete());
  const domain::Motion a = first.step(odometry_at(0.1, {}, 0.2), free_scan(), {6.0, 0.0});
  const domain::Motion b = restored.step(odometry_at(0.1, {}, 0.2), free_scan(), {6.0, 0.0});
  EXPECT_EQ(a.speed_mps, b.speed_mps);
  EXPECT_EQ(a.turn_rate_radps, b.turn_rate_radps);
}

TEST(PolarNeuralMap, ShowsMapReturnsWindowAndSubgoalOfItsLastStep) {
  PolarNeuralMap controller({}, setup());
  controller.step(odometry_at(0.0, {}), wall_scan(0.6), {6.0, 0.1});

  domain::Inside inside;
  controller.tell(odometry_at(0.0, {}), wall_scan(0.6), {6.0, 0.1}, inside);

  const domain::Picture& picture = inside.picture;
  std::vector<std::string> names;
  for (const auto& layer : picture.layers) names.push_back(layer.name);
  EXPECT_EQ(names, (std::vector<std::string>{"activation of the map", "obstructed units",
                                             "remembered returns", "way to a stop", "subgoal"}));
  EXPECT_EQ(picture.layers[2].places_odom.size(), 5u);  // the beams of the wall
  EXPECT_EQ(picture.charts.size(), 1u);
}

TEST(PolarNeuralMap, RefusesASensorThatDoesNotShowWhatIsAround) {
  domain::BehaviourSetup four = setup();
  four.scan = {"infrared", 4, radians(90.0), radians(-90.0), 0.0, 0.8};
  domain::BehaviourSetup front = setup();
  front.scan = {"cones", 7, radians(45.0), radians(-15.0), radians(15.0), 1.5};

  const auto with_four = PolarNeuralMap::create({}, four);
  const auto with_front = PolarNeuralMap::create({}, front);

  ASSERT_FALSE(with_four.ok());
  EXPECT_EQ(with_four.error().message,
            "polar_neural_map needs 2 beams or more, at most 30 degrees from beam to beam, a view "
            "out to 90 degrees on each side; 'infrared' gives 4 beams of 0 degrees, 90 degrees "
            "apart from 90 on");
  ASSERT_FALSE(with_front.ok());
  EXPECT_NE(with_front.error().message.find("'cones' gives 7 beams of 15 degrees"),
            std::string::npos);
}

}  // namespace
}  // namespace clew::control
