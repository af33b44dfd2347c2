// SPDX-License-Identifier: Apache-2.0
/// A heading that the mission wants at its target: every shipped graph reaches the target without
/// one, and meets it, whatever steers, plans and recovers in it.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>

#include "core/angle.hpp"
#include "mission.hpp"

namespace clew::stages {
namespace {

using domain::Outcome;

constexpr int kMostTicks = 1500;
constexpr double kHeading_rad = -2.5;
constexpr double kTolerance_rad = 0.05;

/// An empty room, in a file that is removed at the end.
class Room {
 public:
  explicit Room(const std::string& rest)
      : path_(testing::TempDir() + "goal-heading-" + std::to_string(::getpid()) + ".yaml") {
    std::ofstream(path_) << "format: clew-world/1\nname: room\nbounds: [0, 0, 8, 6]\n"
                            "start: [1.5, 3, 0]\ntarget: [6, 3.5]\ntarget_radius: 0.2\n"
                         << rest;
  }
  ~Room() { std::remove(path_.c_str()); }
  Room(const Room&) = delete;
  Room& operator=(const Room&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

std::string heading_text() {
  return "[" + std::to_string(kHeading_rad) + ", " + std::to_string(kTolerance_rad) + "]";
}

domain::State end_of(const std::string& graph, const std::string& rest) {
  const Room room(rest);
  Mission mission(graph, room.path());
  for (int tick = 0; tick < kMostTicks && !mission.over(); ++tick) mission.step();
  return mission.state();
}

class GoalHeading : public testing::TestWithParam<std::string> {};

TEST_P(GoalHeading, IsMetWhereTheTargetIsReached) {
  const domain::State without = end_of(GetParam(), "");
  ASSERT_EQ(without.outcome, Outcome::kReached);

  const domain::State with = end_of(GetParam(), "target_heading: " + heading_text() + "\n");

  ASSERT_EQ(with.outcome, Outcome::kReached);
  EXPECT_LE(std::fabs(core::wrap_angle_rad(with.pose_world_robot.heading_rad - kHeading_rad)),
            kTolerance_rad);
  EXPECT_LE(core::length(with.pose_world_robot.position() - core::Vec2(6.0, 3.5)), 0.2);
  EXPECT_GT(with.stamp.tick, without.stamp.tick);
  // A controller that does not slow down passes by and comes back.
  EXPECT_LE(with.path_length_m, without.path_length_m + 1.0);
}

INSTANTIATE_TEST_SUITE_P(All, GoalHeading, testing::ValuesIn(shipped_graphs()));

TEST(GoalHeading, OfAWaypointIsMetBeforeTheNextOne) {
  const Room room("waypoints: [[4, 2, 0.2, 3, 0.1]]\ntarget_heading: 0\n");
  Mission mission("default", room.path());
  bool met = false;
  for (int tick = 0; tick < kMostTicks && !mission.over(); ++tick) {
    mission.step();
    const core::Pose2& pose = mission.state().pose_world_robot;
    met = met || (core::distance_m(pose, core::Vec2(4.0, 2.0)) <= 0.2 &&
                  std::fabs(core::wrap_angle_rad(pose.heading_rad - 3.0)) <= 0.1);
  }

  EXPECT_TRUE(met);
  EXPECT_EQ(mission.state().outcome, Outcome::kReached);
}

}  // namespace
}  // namespace clew::stages
