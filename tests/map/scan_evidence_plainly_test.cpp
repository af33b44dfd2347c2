// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/angle.hpp"
#include "core/archive.hpp"
#include "core/random.hpp"
#include "map/scan_evidence.hpp"
#include "plain_scan_evidence.hpp"

namespace clew::map {
namespace {

constexpr double kRadius_m = 0.15;

/// Draws scans, and poses from which they are taken one after the other.
class Draw {
 public:
  explicit Draw(std::uint64_t trial) : random_({7, 0, 0, trial}) {}

  double between(double least, double most) {
    return least + (most - least) * random_.uniform(drawn_++);
  }
  bool one_in(int many) { return between(0.0, many) < 1.0; }

  /// A layout: lasers, cones side by side and apart, a ring of sonars, rays far apart.
  domain::Scan layout() {
    domain::Scan scan;
    const auto fan = [&](double first_deg, double step_deg, double width_deg, std::size_t count) {
      scan.bearing_first_rad = core::radians(first_deg);
      scan.bearing_step_rad = core::radians(step_deg);
      scan.beam_width_rad = core::radians(width_deg);
      scan.ranges_m.resize(count);
    };
    switch (static_cast<int>(between(0.0, 6.0))) {
      case 0:
        fan(90.0, -0.5, 0.0, 361);
        break;
      case 1:
        fan(180.0, -1.0, 0.0, 361);
        break;
      case 2:
        fan(45.0, -15.0, 15.0, 7);
        break;
      case 3:
        fan(-180.0, 22.5, 25.0, 16);
        break;
      case 4:
        fan(60.0, between(-20.0, -1.0), between(0.5, 40.0), 5);
        break;
      default:
        fan(between(-180.0, 180.0), between(-3.0, 3.0), 0.0, 60);
        break;
    }
    scan.range_max_m = one_in(2) ? 1.5 : between(0.2, 6.0);
    return scan;
  }
  /// Pieces of walls, between which nothing is seen, and some outliers.
  void measure(domain::Scan& scan) {
    double range_m = 0.0;
    for (double& reading_m : scan.ranges_m) {
      if (one_in(9)) range_m = between(-0.3, 1.2) * scan.range_max_m;
      range_m *= between(0.99, 1.01);
      reading_m = std::clamp(one_in(20) ? between(0.0, 5.0) : range_m, 0.0, scan.range_max_m);
    }
  }
  /// Anywhere, or where sides and places lie on the lines between cells.
  core::Pose2 pose() {
    const double far_m = one_in(10) ? 3.0e4 : one_in(5) ? 2.0e3 : 1.5;
    core::Pose2 pose{between(-far_m, far_m), between(-far_m, far_m),
                     between(-core::kPi, core::kPi)};
    if (one_in(4)) pose.x_m = 0.0125 * std::round(pose.x_m / 0.0125);
    if (one_in(4)) pose.y_m = 1.6 * std::round(pose.y_m / 1.6);
    if (one_in(4)) pose.heading_rad = core::radians(0.5 * std::round(between(-360.0, 360.0)));
    return pose;
  }

 private:
  core::Random random_;
  std::uint32_t drawn_ = 0;
};

std::string bytes_of(SeenMap& seen) {
  core::StateWriter writer;
  writer(seen.state());
  return writer.bytes();
}

TEST(ScanEvidenceAgainstThePlainOne, MarksTheSameCells) {
  for (std::uint64_t trial = 0; trial < 160; ++trial) {
    Draw draw(trial);
    const std::size_t capacity = draw.one_in(4) ? 12 : 4096;
    SeenMap seen(0.025, capacity);
    SeenMap plainly_seen(0.025, capacity);
    ScanEvidence evidence({}, kRadius_m);
    const PlainScanEvidence plain({}, kRadius_m);
    domain::Odometry odometry;
    odometry.pose_odom_robot = draw.pose();
    domain::Scan scan = draw.layout();
    for (int tick = 0; tick < 8; ++tick) {
      draw.measure(scan);

      evidence.mark(odometry, scan, seen);
      plain.mark(odometry, scan, plainly_seen);

      ASSERT_EQ(bytes_of(seen), bytes_of(plainly_seen)) << "trial " << trial << ", tick " << tick;
      ASSERT_TRUE(is_valid(seen.state()));
      core::Pose2& pose = odometry.pose_odom_robot;
      pose.x_m += draw.between(-0.1, 0.1);
      pose.y_m += draw.between(-0.1, 0.1);
      if (!draw.one_in(3)) pose.heading_rad += draw.between(-0.5, 0.5);
      if (draw.one_in(8)) odometry.contact_bearings_rad.push_back(draw.between(-3.0, 3.0));
      if (draw.one_in(8)) scan = draw.layout();
    }
  }
}

}  // namespace
}  // namespace clew::map
