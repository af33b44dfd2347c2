// SPDX-License-Identifier: Apache-2.0
#include "map/no_room.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/angle.hpp"

namespace clew::map {
namespace {

constexpr double kRadius_m = 0.15;
constexpr double kCell_m = 0.05;

/// A robot that heads along x at (x, 0), with beams over 180 degrees ahead and a degree between
/// them. Before it, a thin wall at x = 0 with a gap in its middle.
struct Look {
  domain::Odometry odometry;
  domain::Scan scan;

  Look(double x_m, double gap_m) {
    odometry.pose_odom_robot = {x_m, 0.0, 0.0};
    scan.bearing_first_rad = core::radians(90.0);
    scan.bearing_step_rad = core::radians(-1.0);
    scan.range_max_m = 4.0;
    for (int i = 0; i <= 180; ++i) {
      const double bearing_rad = core::radians(90.0 - i);
      const double across_m = std::fabs(x_m * std::tan(bearing_rad));
      const bool hits = std::fabs(bearing_rad) < 1.5 && across_m >= 0.5 * gap_m;
      const double distance_m = hits ? -x_m / std::cos(bearing_rad) : 9.0;
      scan.ranges_m.push_back(std::min(4.0, distance_m - kRadius_m));
    }
  }
};

/// The rows of cells between y = -0.2 and 0.2 that are closed at x from -0.05 to 0.05.
std::size_t closed_rows(const NoRoom& no_room) {
  std::vector<bool> rows(8, false);
  no_room.for_each(kCell_m, [&](const Vec2& middle) {
    if (std::fabs(middle.x()) > 0.06 || std::fabs(middle.y()) > 0.2) return;
    rows[static_cast<std::size_t>(std::floor((middle.y() + 0.2) / kCell_m))] = true;
  });
  return static_cast<std::size_t>(std::count(rows.begin(), rows.end(), true));
}

TEST(NoRoom, ClosesAGapThatTheBodyDoesNotFitThrough) {
  NoRoom no_room(kRadius_m);
  const Look look(-0.1, 0.25);

  no_room.see(look.odometry, look.scan, kCell_m);

  EXPECT_EQ(closed_rows(no_room), 8U);
}

TEST(NoRoom, LeavesAGapOpenThatTheBodyFitsThrough) {
  for (const double gap_m : {0.302, 0.315, 0.36}) {
    NoRoom no_room(kRadius_m);
    for (const double x_m : {-0.2, -0.15, -0.1, -0.05}) {
      const Look look(x_m, gap_m);
      no_room.see(look.odometry, look.scan, kCell_m);
    }

    EXPECT_LE(closed_rows(no_room), 6U) << gap_m;
  }
}

TEST(NoRoom, ClosesOnlyWhatIsClosedWhereverOnItsArcTheObstacleIs) {
  Look look(-0.1, 0.25);
  look.scan.beam_width_rad = core::radians(60.0);
  look.scan.bearing_first_rad = core::radians(60.0);
  look.scan.bearing_step_rad = core::radians(-120.0);
  look.scan.ranges_m = {0.01, 0.01};
  NoRoom no_room(kRadius_m);

  no_room.see(look.odometry, look.scan, kCell_m);

  EXPECT_LT(closed_rows(no_room), 8U);
}

TEST(NoRoom, OpensTheCellThatTheRobotIsIn) {
  NoRoom no_room(kRadius_m);
  const Look look(-0.1, 0.25);
  no_room.see(look.odometry, look.scan, kCell_m);
  ASSERT_EQ(closed_rows(no_room), 8U);
  Look inside(-0.01, 0.25);
  inside.scan.ranges_m.assign(181, 4.0);

  no_room.see(inside.odometry, inside.scan, kCell_m);

  bool closed = false;
  no_room.for_each(kCell_m, [&](const Vec2& middle) {
    closed = closed || core::length(middle - Vec2(-0.025, 0.025)) < 0.01;
  });
  EXPECT_FALSE(closed);
}

TEST(NoRoom, KeepsItsState) {
  NoRoom no_room(kRadius_m);
  const Look look(-0.1, 0.25);
  no_room.see(look.odometry, look.scan, kCell_m);
  core::StateWriter writer;
  no_room.save(writer);
  NoRoom loaded(kRadius_m);

  core::StateReader reader(writer.bytes());
  loaded.load(reader);

  EXPECT_TRUE(reader.complete()) << reader.fault();
  EXPECT_EQ(closed_rows(loaded), 8U);
}

}  // namespace
}  // namespace clew::map
