// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fleet/fleet_file.hpp"

namespace clew::encounters {

/// Robots that are in each other's way: in the open, in a corridor, at a door.
enum class Family : std::uint8_t { kCrossing, kCorridor, kDoor };

/// `crossing`, `corridor`, `door`.
const std::vector<std::string>& family_names();

inline constexpr int kLeastRobots = 2;
inline constexpr int kMostRobots = 20;

/// A world and the robots in it.
struct Encounter {
  std::string name;  ///< `door-08-3`: family, robots, number
  Family family = Family::kCrossing;
  std::string world;  ///< a world file
  fleet::FleetFile fleet;
};

/// A function of its arguments: the same bytes anywhere. `robots` from kLeastRobots to kMostRobots.
///
/// *Crossing*: robots on a ring, each to the other side of it. *Corridor*: two rooms and a corridor
/// of 3 m between them, 0.5 m to 1.2 m wide, half of the robots from each side. *Door*: two rooms
/// and a door of 0.5 m to 0.8 m.
Encounter make_encounter(Family family, int robots, std::uint32_t number, std::uint64_t seed,
                         const std::string& graph);

}  // namespace clew::encounters
