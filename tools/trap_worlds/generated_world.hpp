// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "core/result.hpp"
#include "trap_worlds/families.hpp"

namespace clew::trap_worlds {

/// What decides a generated world, to the byte.
struct WorldOrder {
  const Family* family = nullptr;
  std::uint64_t seed = 1;
  int number = 0;  ///< of `count`, from 0
  int count = 1;
  double sensing_range_m = 1.5;
  double robot_radius_m = 0.15;
};

struct GeneratedWorld {
  std::string name;           ///< `u-s1-03`
  std::string text;           ///< a world file, `clew-world/1`
  double depth_ranges = 0.0;  ///< the family's depth, in sensing ranges
};

/// Depths, in sensing ranges, go from the least to the most, by equal factors.
inline constexpr double kLeastDepth_ranges = 0.3;
inline constexpr double kMostDepth_ranges = 4.0;

/// Minima shallower than the robot is wide are no traps; see world_analysis::Trap.
inline constexpr double kLeastTrapDepth_m = 0.3;

/// The name that the world of an order will have.
std::string world_name(const WorldOrder& order);

/// Draws a world of a family and computes what its file states: whether it is solvable
/// (world_analysis::is_solvable, with 0.02 m to spare; with moving obstacles, as they come to
/// rest), the shortest path (world_analysis::shortest_path; null with moving obstacles) and, in
/// `about`, the deepest trap. What does not come out as the family claims is drawn again with other
/// dice, so no claim is believed. An order of which nothing comes out in 200 draws is a mistake of
/// the family.
GeneratedWorld generate_world(const WorldOrder& order);

}  // namespace clew::trap_worlds
