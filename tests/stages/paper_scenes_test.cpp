// SPDX-License-Identifier: Apache-2.0
/// Scenes of the papers, with the controllers alone: what they leave, and what traps them.
#include <gtest/gtest.h>

#include <algorithm>

#include "mission.hpp"

namespace clew::stages {
namespace {

using domain::Outcome;

constexpr int kTicks = 3000;  // 300 s with a velocity drive; a path past any of the scenes takes 60

/// Where a run went.
struct Course {
  Outcome outcome = Outcome::kRunning;
  double path_length_m = 0.0;
  std::uint32_t collisions = 0;
  double highest_y_m = 0.0;
  std::vector<core::Pose2> poses;
};

Course run(const std::string& graph, const std::string& world,
           const std::vector<std::string>& set = {}) {
  Mission mission(graph, world, {"recover.detector=none", "recover.escape=none"}, set);
  Course course;
  for (int tick = 0; tick < kTicks && !mission.over(); ++tick) {
    mission.step();
    const core::Pose2& pose = mission.state().pose_world_robot;
    course.poses.push_back(pose);
    course.highest_y_m = std::max(course.highest_y_m, pose.y_m);
  }
  course.outcome = mission.state().outcome;
  course.path_length_m = mission.state().path_length_m;
  course.collisions = mission.state().collisions;
  return course;
}

TEST(Nakhaeinia, SafeRegionsOfFigure1LeadAlongTheShortestPath) {
  const Course course = run("nakhaeinia", "n-fig01-safe-regions");

  EXPECT_EQ(course.outcome, Outcome::kReached);
  EXPECT_LT(course.path_length_m, 1.1 * 4.663);  // the world's shortest path
}

TEST(Nakhaeinia, NvtPassesTheClutterOfFigure2) {
  EXPECT_EQ(run("nakhaeinia", "n-fig02-nvt-cluttered").outcome, Outcome::kReached);
}

TEST(Nakhaeinia, NvtAloneLeavesTheVisibleMinimumOfFigure3) {
  const Course course = run("nakhaeinia", "n-fig03-visible-minimum");

  EXPECT_EQ(course.outcome, Outcome::kReached);
  // It sees the whole U (whose arms begin at y = 3 between x = 2.1 and 3.9) from the start, and
  // never goes in.
  for (const core::Pose2& pose : course.poses) {
    EXPECT_FALSE(pose.x_m > 2.25 && pose.x_m < 3.75 && pose.y_m > 3.0 && pose.y_m < 3.7);
  }
  EXPECT_LT(course.path_length_m, 1.1 * 3.977);
}

TEST(Nakhaeinia, NvtAloneIsTrappedInTheInvisibleMinimumOfFigure4) {
  const Course course = run("nakhaeinia", "n-fig04-invisible-minimum");

  EXPECT_EQ(course.outcome, Outcome::kRunning);
  // It goes deep into the U (y from 1.7 to 4.7), beyond what it saw of it from outside, and is
  // never past its end.
  EXPECT_GT(course.highest_y_m, 3.0);
  EXPECT_LT(course.highest_y_m, 4.7);
  EXPECT_EQ(course.collisions, 0u);
}

TEST(PinBender, WithoutMemoryTheRobotOscillatesAgainstTheFarWallOfFigure4) {
  const Course course = run("pin_bender", "pb-fig04-dead-end-chamber");

  EXPECT_EQ(course.outcome, Outcome::kRunning);
  EXPECT_EQ(course.collisions, 0u);
  // In the last 100 s it does not leave the chamber (x from 4 to 10.6), and comes near its far
  // wall.
  const auto last = course.poses.end() - 1000;
  const auto by_x = [](const core::Pose2& a, const core::Pose2& b) { return a.x_m < b.x_m; };
  EXPECT_GT(std::min_element(last, course.poses.end(), by_x)->x_m, 4.0);
  EXPECT_GT(std::max_element(last, course.poses.end(), by_x)->x_m, 10.0);
}

}  // namespace
}  // namespace clew::stages
