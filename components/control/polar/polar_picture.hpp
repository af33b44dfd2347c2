// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "control/polar/dynamic_window.hpp"
#include "control/polar/polar_landscape.hpp"
#include "domain/picture.hpp"

namespace clew::control {

/// A polar map for people, drawn at a pose: the activation, as its logarithm from the least to the
/// greatest on the map; the units that are obstructed.
void draw_landscape(const PolarLandscape& landscape, const core::Pose2& pose_odom_map,
                    domain::Picture& picture);

/// A dynamic window for people, at the pose that it begins at: the objective over speed and turn
/// rate, the better the darker, and the way to a stop that was chosen.
void draw_window(const DynamicWindow& window, const core::Pose2& pose_odom_robot, double cycle_s,
                 domain::Picture& picture);

}  // namespace clew::control
