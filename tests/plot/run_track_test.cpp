// SPDX-License-Identifier: Apache-2.0
#include "plot/run_track.hpp"

#include <gtest/gtest.h>

#include "../recording/scratch_directory.hpp"
#include "small_run.hpp"

namespace clew::plot_test {
namespace {

using core::Vec2;
using recording_test::ScratchDirectory;

/// Poses and places go through sums of a few terms below 10: rounding stays far below this.
constexpr double kTolerance = 1e-12;

void expect_near(const Vec2& found, const Vec2& expected) {
  EXPECT_NEAR(found.x(), expected.x(), kTolerance);
  EXPECT_NEAR(found.y(), expected.y(), kTolerance);
}

TEST(RunTrack, HoldsPathAndRecoveryOfARecordedRun) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("small.mcap");
  SmallRun().write(path);

  const auto track = plot::read_run_track(path);

  ASSERT_TRUE(track.ok()) << track.error().text();
  EXPECT_EQ(track->name, "small");
  EXPECT_EQ(track->world, kWorld);
  EXPECT_EQ(track->robot_radius_m, 0.15);
  EXPECT_EQ(track->seed, 7U);
  EXPECT_FALSE(track->cut_off);
  ASSERT_EQ(track->poses.size(), 10U);
  EXPECT_EQ(track->poses[9].x_m, 5.5);
  const std::vector<bool> recovering = {false, false, false, false, true,
                                        true,  true,  false, false, false};
  EXPECT_EQ(track->recovering, recovering);
  EXPECT_EQ(track->last_state.outcome, domain::Outcome::kReached);
}

TEST(RunTrack, HoldsVirtualObstaclesAndTheControllersVirtualTargetsOnceEach) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("small.mcap");
  SmallRun().write(path);

  const auto track = plot::read_run_track(path);

  ASSERT_TRUE(track.ok()) << track.error().text();
  // Odometry is 1 m behind in x, and 1.5 m in y at tick 5 and 1.8 m at tick 2.
  ASSERT_EQ(track->virtual_obstacles.size(), 1U);
  expect_near(track->virtual_obstacles[0][0], {3.5, 2.5});
  expect_near(track->virtual_obstacles[0][2], {4.5, 3.0});
  ASSERT_EQ(track->controller_targets.size(), 1U);
  expect_near(track->controller_targets[0], {5.0, 2.0});
}

TEST(RunTrack, TakesPlacesFromADriftedOdometryToThePath) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("small.mcap");
  SmallRun().write(path);

  const auto track = plot::read_run_track(path);

  ASSERT_TRUE(track.ok()) << track.error().text();
  ASSERT_EQ(track->traps.size(), 1U);
  expect_near(track->traps[0].position, {3.0, 2.0});  // where the robot stood at tick 4
  ASSERT_TRUE(track->traps[0].earlier);
  expect_near(*track->traps[0].earlier, {1.5, 2.0});  // and at tick 1, 0.3 m of drift before
  ASSERT_EQ(track->virtual_targets.size(), 1U);
  expect_near(track->virtual_targets[0].position, {6.0, 2.0});  // 2 m ahead of tick 6
  expect_near(track->virtual_targets[0].from, {4.0, 2.0});
  // It believes to be 0.1 m farther to the left with each tick.
  ASSERT_EQ(track->believed.size(), 10U);
  expect_near(track->believed[5], {3.5, 2.5});
  EXPECT_EQ(track->virtual_obstacles.size(), 1U);
  ASSERT_EQ(track->marks.size(), 2U);
  EXPECT_EQ(track->marks[1].kind, domain::EventKind::kEscapeEnded);
  expect_near(track->marks[1].position, {4.5, 2.0});
  ASSERT_EQ(track->landmarks.size(), 2U);
  EXPECT_EQ(track->landmarks[1].network, domain::Network::kFuzzyArt);
  expect_near(track->landmarks[1].position, {3.0, 2.0});
  ASSERT_EQ(track->safety_stops.size(), 1U);
  expect_near(track->safety_stops[0], {5.0, 2.0});
  EXPECT_TRUE(track->collisions.empty());
  ASSERT_EQ(track->hits.size(), 1U);
  expect_near(track->hits[0], {2.5, 2.0});
}

TEST(RunTrack, GoesUpToTheTearOfARecordingThatWasCutOff) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("cut.mcap");
  SmallRun().write(path, false);

  const auto track = plot::read_run_track(path);

  ASSERT_TRUE(track.ok()) << track.error().text();
  EXPECT_TRUE(track->cut_off);
  // The open chunk was that of second 4, ticks 8 and 9.
  EXPECT_EQ(track->poses.size(), 8U);
}

TEST(RunTrack, IsReadFromOtherMessageTypesToo) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("other.mcap");
  SmallRun run;
  run.description.idl_fingerprint = "0123";
  run.write(path);

  const auto track = plot::read_run_track(path);

  ASSERT_TRUE(track.ok()) << track.error().text();
  EXPECT_FALSE(track->poses.empty());
}

TEST(RunTrack, RefusesARecordingWithoutItsWorld) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("bare.mcap");
  SmallRun run;
  run.description.bundle.erase("world.yaml");
  run.write(path);

  const auto track = plot::read_run_track(path);

  ASSERT_FALSE(track.ok());
  EXPECT_EQ(track.error().text(), path + ": does not hold the run's world.yaml and robot.yaml");
}

}  // namespace
}  // namespace clew::plot_test
