// SPDX-License-Identifier: Apache-2.0
/// Targets right behind the robot, and plain walls before a controller that remembers nothing.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <string>

#include "mission.hpp"

namespace clew::stages {
namespace {

using domain::Outcome;

/// A room of 20 m by 12 m in a file, removed at the end.
class Room {
 public:
  explicit Room(const std::string& rest)
      : path_(testing::TempDir() + "near-targets-" + std::to_string(::getpid()) + ".yaml") {
    std::ofstream(path_) << "format: clew-world/1\nname: room\nbounds: [0, 0, 20, 12]\n" << rest;
  }
  ~Room() { std::remove(path_.c_str()); }
  Room(const Room&) = delete;
  Room& operator=(const Room&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

TEST(NearTarget, BehindTheRobotIsReachedOnAShortPath) {
  for (const double distance_m : {0.25, 0.3, 0.4, 0.5}) {
    const Room room("start: [5, 5, 0]\ntarget: [" + std::to_string(5.0 - distance_m) +
                    ", 5]\ntarget_radius: 0.1\n");
    for (const std::string graph : {"default", "any_sensor", "krishna_kalra", "reactive"}) {
      SCOPED_TRACE(graph + " " + std::to_string(distance_m));
      Mission mission(graph, room.path());
      for (int tick = 0; tick < 200 && !mission.over(); ++tick) mission.step();

      EXPECT_EQ(mission.state().outcome, Outcome::kReached);
      // What counts as an arrival in the suite of that name.
      EXPECT_LE(mission.state().path_length_m, 1.2 * distance_m + 0.3);
      EXPECT_EQ(mission.state().collisions, 0u);
    }
  }
}

/// A room with a wall across the way, this long and so far before the robot.
std::string with_wall(double length_m, double ahead_m) {
  const auto text = [](double number) { return std::to_string(number); };
  return "start: [" + text(10.0 - ahead_m) + ", 6, 0]\ntarget: [17, 6]\ntarget_radius: 0.2\n" +
         "walls: [[10, " + text(6.0 - length_m / 2) + ", 10, " + text(6.0 + length_m / 2) + "]]\n";
}

TEST(Nakhaeinia, PassesAPlainWall) {
  for (const double length_m : {2.0, 4.0, 8.0}) {
    for (const double ahead_m : {0.5, 1.0, 4.0}) {
      SCOPED_TRACE(std::to_string(length_m) + " " + std::to_string(ahead_m));
      const Room room(with_wall(length_m, ahead_m));
      Mission mission("nakhaeinia", room.path());
      for (int tick = 0; tick < 1000 && !mission.over(); ++tick) mission.step();

      EXPECT_EQ(mission.state().outcome, Outcome::kReached);
      EXPECT_EQ(mission.state().collisions, 0u);
    }
  }
}

// It has no memory, in the paper either: along a wall whose ends it takes for closed it goes to and
// fro, and a gap in view leads on, so that no trap is noticed. But it never stands still.
TEST(Nakhaeinia, StaysInMotionBeforeAWallThatItDoesNotPass) {
  constexpr int kMinute = 600;  // ticks of 0.1 s
  const Room room(with_wall(11.0, 2.0));
  Mission mission("nakhaeinia", room.path());
  double before_m = 0.0;
  for (int minute = 0; minute < 5; ++minute) {
    for (int tick = 0; tick < kMinute && !mission.over(); ++tick) mission.step();
    const double path_length_m = mission.state().path_length_m;

    EXPECT_GT(path_length_m - before_m, 5.0) << "minute " << minute;
    before_m = path_length_m;
  }
  EXPECT_EQ(mission.state().outcome, Outcome::kRunning);
  EXPECT_EQ(mission.state().collisions, 0u);
}

}  // namespace
}  // namespace clew::stages
