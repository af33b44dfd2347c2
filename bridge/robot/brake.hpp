// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "core/geometry.hpp"
#include "domain/motion_conversion.hpp"

namespace clew::robot {

/// Which obstacle a robot would come too near to.
///
/// The robot, a disc of `radius_m`, goes on as `velocities` for `horizon_s`. Asked is the direction
/// of the first of `obstacles` (in its frame) that it then comes nearer to than that; one that is
/// nearer already counts if it comes nearer still. None if there is no such obstacle: turning on
/// the spot brings a disc nearer to nothing.
std::optional<double> bearing_of_contact_rad(const std::vector<core::Vec2>& obstacles,
                                             double radius_m, const domain::Velocities& velocities,
                                             double horizon_s);

}  // namespace clew::robot
