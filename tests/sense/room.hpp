// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "sense/range_sensor.hpp"

namespace clew::sense {

inline constexpr double kRadius_m = 0.15;

/// A room of 20 m by 20 m with the given obstacles.
inline world::World make_room(const std::string& obstacles) {
  auto world =
      world::World::parse("format: clew-world/1\nname: test\nbounds: [0, 0, 20, 20]\n" + obstacles +
                              "\nstart: [1, 1, 0]\ntarget: [19, 19]\ntarget_radius: 0.2\n",
                          "test.yaml");
  EXPECT_TRUE(world.ok()) << world.error().text();
  return std::move(world).value();
}

/// What a sensor of a robot at `pose` reads in the room.
inline domain::Scan measure(const RangeSensor& sensor, const world::World& room,
                            const core::Pose2& pose) {
  domain::Scan scan;
  sensor.measure(room, pose, 0.0, core::Random({1, 0, 1, 0}), scan);
  return scan;
}

/// Whether a scan is of the layout that its sensor promised.
inline void expect_layout(const RangeSensor& sensor, const domain::Scan& scan) {
  const domain::ScanLayout layout = sensor.layout();
  EXPECT_EQ(scan.ranges_m.size(), layout.beam_count);
  EXPECT_EQ(scan.bearing_first_rad, layout.bearing_first_rad);
  EXPECT_EQ(scan.bearing_step_rad, layout.bearing_step_rad);
  EXPECT_EQ(scan.beam_width_rad, layout.beam_width_rad);
  EXPECT_EQ(scan.range_max_m, layout.range_max_m);
}

}  // namespace clew::sense
