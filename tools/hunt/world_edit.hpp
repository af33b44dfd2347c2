// SPDX-License-Identifier: Apache-2.0
/// Worlds that a search has changed: written as files, and what is true of them computed anew.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "world/world_file.hpp"

namespace clew::hunt {

/// A world as a file, `clew-world/1`. Numbers read back as themselves.
std::string world_text(const world::WorldFile& world);

/// Puts `solvable` and `shortest_path` right for a robot: what the file said holds for the world
/// before it was changed. Neither is stated where it is not known: where something moves for ever,
/// or only gaps about as wide as the robot lead on; the path not where anything moves. Refused: a
/// world that is none any more, such as one with a start inside an obstacle.
core::Result<void> settle_claims(world::WorldFile& world, double robot_radius_m);

/// Where a place of the unit cube (x and y as shares of the bounds, heading as a share of a turn)
/// lies in a world: at the nearest place of the lattice that the robot gets to from the world's own
/// start with 0.02 m to spare, where nothing moves at time 0, and that is not at the target
/// already. So the world is as solvable from there as it was. None if there is no such place.
std::optional<core::Pose2> start_at(const world::World& world, double robot_radius_m,
                                    const std::array<double, 3>& shares);

}  // namespace clew::hunt
