// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/geometry.hpp"
#include "domain/messages.hpp"

namespace clew::classify {

struct RangePatternParameters {
  double join_m = 0.12;
  double widest_m = 0.9;
};

/// An object that stands out in the ranges of a scan.
struct SeenObject {
  core::Vec2 centre_robot = core::Vec2::Zero();
  double width_m = 0.0;
};

/// The objects of a scan: neighbouring beams whose returns lie within join_m of each other, and
/// what the beams part. A beam of another range between two that belong together is taken for an
/// error.
///
/// Only what is seen whole is an object: behind both of its ends the scan sees farther. So no piece
/// of a wall is one that something in front or the edge of the field cuts off; nor is one that ends
/// where the sensor's range does, which moves as the robot does. What is wider than widest_m is a
/// wall. The centre is that of a disc as wide as what is seen.
void find_objects(const domain::Scan& scan, double robot_radius_m,
                  const RangePatternParameters& parameters, std::vector<SeenObject>& objects);

}  // namespace clew::classify
