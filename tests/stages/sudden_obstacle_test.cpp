// SPDX-License-Identifier: Apache-2.0
/// Obstacles that appear where the robot is.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "core/geometry.hpp"
#include "mission.hpp"

namespace clew::stages {
namespace {

using domain::Outcome;

constexpr int kMostTicks = 3000;

/// A world in a file, removed at the end.
class WorldFile {
 public:
  explicit WorldFile(const std::string& text)
      : path_(testing::TempDir() + "sudden-" + std::to_string(::getpid()) + ".yaml") {
    std::ofstream(path_) << "format: clew-world/1\nname: sudden\ntarget_radius: 0.2\n" << text;
  }
  ~WorldFile() { std::remove(path_.c_str()); }
  WorldFile(const WorldFile&) = delete;
  WorldFile& operator=(const WorldFile&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

std::string text(double number) { return std::to_string(number); }

// The four rays of infrared see too little around the robot: it is stopped twice there.
const std::vector<std::string> kSensors = {"cones", "laser", "sonar_ring"};

std::vector<std::string> settings_of(const std::string& sensor) {
  if (sensor == "laser") return {"sense.range_m=4"};
  return {};
}

/// A disc comes over the robot's place at 5 s within 0.05 s, and leaves it 30 s later.
std::string sudden_disc(double radius_m, double x_m, double y_m) {
  const std::string there = text(x_m) + ", " + text(y_m);
  return "bounds: [0, 0, 14, 10]\nmoving: [{circle: [2, 8.5, " + text(radius_m) +
         "], loop: false, path: [[0, 2, 8.5], [5, 2, 8.5], [5.05, " + there + "], [35, " + there +
         "], [35.05, 2, 8.5], [900, 2, 8.5]]}]\nstart: [2, 5, 0]\ntarget: [12, 5]\n";
}

TEST(SuddenObstacle, OnTheRobotIsWaitedFor) {
  for (const double radius_m : {0.2, 0.5, 1.0}) {
    for (const core::Vec2& place :
         {core::Vec2(4.2, 5.0), core::Vec2(4.35, 5.0), core::Vec2(4.3, 5.2)}) {
      const WorldFile world(sudden_disc(radius_m, place.x(), place.y()));
      for (const std::string& sensor : kSensors) {
        SCOPED_TRACE(sensor + " " + text(radius_m) + " at " + text(place.x()) + " " +
                     text(place.y()));
        Mission mission("any_sensor", world.path(), {"sense=" + sensor}, settings_of(sensor));
        for (int tick = 0; tick < kMostTicks && !mission.over(); ++tick) mission.step();

        EXPECT_EQ(mission.state().outcome, Outcome::kReached);
        EXPECT_EQ(mission.state().collisions, 0u);
        EXPECT_LE(mission.state().safety_stops, 1u);
        EXPECT_GE(mission.state().hit_by, 1u);  // the disc came over the robot
      }
    }
  }
}

}  // namespace
}  // namespace clew::stages
