// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/geometry.hpp"

namespace clew::path_methods {

/// Length of a polyline.
double length_m(const std::vector<core::Vec2>& path);

/// How much a polyline bends: the sum of the squares of its turns, in rad^2, between points that
/// are `step_m` apart along it. A turn of 90 degrees in one place is 2.5, spread over ten steps
/// 0.25.
double squared_turning_rad2(const std::vector<core::Vec2>& path, double step_m);

}  // namespace clew::path_methods
