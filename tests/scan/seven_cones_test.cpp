// SPDX-License-Identifier: Apache-2.0
#include "scan/seven_cones.hpp"

#include <gtest/gtest.h>

#include "core/angle.hpp"

namespace clew::scan {
namespace {

using core::radians;

/// Rays a degree apart from -90 to 90 degrees, that see 4 m.
domain::Scan laser() {
  domain::Scan scan;
  scan.bearing_first_rad = radians(-90.0);
  scan.bearing_step_rad = radians(1.0);
  scan.range_max_m = 4.0;
  scan.ranges_m.assign(181, 4.0);
  return scan;
}

TEST(SevenCones, GiveConesAsTheyAre) {
  SevenCones eyes(1.5);
  domain::Scan scan;
  scan.bearing_first_rad = radians(45.0);
  scan.bearing_step_rad = radians(-15.0);
  scan.beam_width_rad = radians(15.0);
  scan.range_max_m = 1.0;
  scan.ranges_m = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 1.0};

  const domain::Scan& cones = eyes.see(scan);

  EXPECT_EQ(cones.ranges_m, scan.ranges_m);
  EXPECT_EQ(cones.range_max_m, 1.0);
  EXPECT_EQ(cones.bearing_first_rad, scan.bearing_first_rad);
}

TEST(SevenCones, TakeTheLeastReadingOfASector) {
  SevenCones eyes(1.5);
  domain::Scan scan = laser();
  scan.ranges_m[90 + 45] = 0.9;
  scan.ranges_m[90 + 39] = 0.8;  // from 37.5 degrees on it is the leftmost sector
  scan.ranges_m[90 - 46] = 0.7;
  scan.ranges_m[90 + 60] = 0.1;  // in none
  scan.ranges_m[90] = 2.0;       // farther than they see

  const domain::Scan& cones = eyes.see(scan);

  EXPECT_EQ(cones.ranges_m, (std::vector<double>{0.8, 1.5, 1.5, 1.5, 1.5, 1.5, 0.7}));
  EXPECT_EQ(cones.range_max_m, 1.5);
}

TEST(SevenCones, AskForABeamInEachSector) {
  // Sixteen sonars, 22.5 degrees apart: as rays they miss the sectors at 15 and 30 degrees.
  domain::ScanLayout sonars{"sonars", 16, 0.0, radians(22.5), radians(25.0), 3.0};
  domain::ScanLayout rays = sonars;
  rays.beam_width_rad = 0.0;

  EXPECT_TRUE(SevenCones::check(sonars, "it").ok());
  EXPECT_FALSE(SevenCones::check(rays, "it").ok());
}

TEST(SevenCones, AreOnlyThoseOfSevenBeamsAtTheirBearings) {
  const domain::ScanLayout cones = {
      "cones", 7, core::radians(45.05), core::radians(-15.0), core::radians(15.0), 1.5};
  domain::ScanLayout six = cones;
  six.beam_count = 6;
  domain::ScanLayout turned = cones;
  turned.bearing_first_rad = core::radians(45.2);
  domain::ScanLayout counter_clockwise = cones;
  counter_clockwise.bearing_step_rad = core::radians(15.0);
  domain::ScanLayout blind = cones;
  blind.range_max_m = 0.0;

  EXPECT_TRUE(SevenCones::are(cones));
  for (const auto& other : {six, turned, counter_clockwise, blind}) {
    EXPECT_FALSE(SevenCones::are(other));
  }
}

}  // namespace
}  // namespace clew::scan
